"""Data of tree files: arrays of points and branches through every format that holds them, tables that are joined, colours."""

import base64
import csv
import json
import math
import struct
import unittest
import xml.etree.ElementTree

import png
from ramus import CommandLineTest

NAN = float("nan")

# A stem of two segments that forks: branches 0, 1, 2; points 0 to 4, in mm.
PLACES = [(0, 0, 0), (0, 0, 20), (0, 0, 40), (20, 0, 60), (-20, 0, 60)]
RADII = [4, 4, 4, 3, 2.5]
BRANCHES = [[0, 1, 2], [2, 3], [2, 4]]
PRESSURE = [90.5, 85.25, 80, 60, NAN]
FLOW = [12, 8.5, 3.5]


def number(value):
    return None if math.isnan(value) else value


def own_json(**more):
    tree = {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
            "points": [[*place, radius] for place, radius in zip(PLACES, RADII)], "branches": BRANCHES, "roots": [0],
            "notes": [], "point_data": {"pressure": [number(p) for p in PRESSURE]}, "branch_data": {"flow": FLOW}}
    return json.dumps({**tree, **more})


def vtk_legacy(extra="", pressure=PRESSURE):
    lines = ["# vtk DataFile Version 3.0", "a tree", "ASCII", "DATASET POLYDATA", "POINTS 5 double"]
    lines += [" ".join(map(str, place)) for place in PLACES]
    lines += ["LINES 3 10"] + [" ".join(map(str, [len(b), *b])) for b in BRANCHES]
    lines += ["CELL_DATA 3", "SCALARS flow double 1", "LOOKUP_TABLE default", " ".join(map(str, FLOW))]
    lines += ["POINT_DATA 5", "FIELD FieldData 2", "Radius 1 5 double", " ".join(map(str, RADII)),
              f"pressure 1 {len(pressure)} double", " ".join(map(str, pressure)), extra]
    return "\n".join(lines) + "\n"


def vtk_array(name, values, kind="Float64", components=1):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
            f'{" ".join(map(str, values))}</DataArray>')


def vtu():
    corners = [p for branch in BRANCHES for p in branch]
    return ('<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>'
            '<Piece NumberOfPoints="5" NumberOfCells="3"><PointData>' + vtk_array("Radius", RADII) +
            vtk_array("pressure", PRESSURE) + vtk_array("velocity", [0] * 15, components=3) + "</PointData><CellData>" +
            vtk_array("flow", FLOW) + '<Array type="String" Name="names" format="ascii">97 0 98 0 99 0</Array></CellData>'
            "<Points>" + vtk_array("Points", [c for place in PLACES for c in place], components=3) + "</Points><Cells>" +
            vtk_array("connectivity", corners, "Int64") + vtk_array("offsets", [3, 5, 7], "Int64") +
            vtk_array("types", [4, 4, 4], "UInt8") + "</Cells></Piece></UnstructuredGrid></VTKFile>")


EDGES = [(a, b, branch) for branch, points in enumerate(BRANCHES) for a, b in zip(points, points[1:])]


def text(value):
    return "" if math.isnan(value) else str(value)


def graphml():
    nodes = "".join(
        f'<node id="n{n}">' + "".join(f'<data key="v_{k}">{v}</data>' for k, v in zip("XYZ", place)) +
        f'<data key="v_r">{radius}</data>' +
        ("" if math.isnan(pressure) else f'<data key="v_p">{pressure}</data>') + "</node>"
        for n, (place, radius, pressure) in enumerate(zip(PLACES, RADII, PRESSURE)))
    edges = "".join(f'<edge source="n{a}" target="n{b}"><data key="e_f">{FLOW[branch]}</data></edge>'
                    for a, b, branch in EDGES)
    keys = "".join(f'<key id="v_{k}" for="node" attr.name="{k}" attr.type="double"/>' for k in "XYZ")
    return ('<graphml>' + keys + '<key id="v_r" for="node" attr.name="radius" attr.type="double"/>'
            '<key id="v_p" for="node" attr.name="pressure" attr.type="double"/>'
            '<key id="e_f" for="edge" attr.name="flow" attr.type="double"/>'
            f'<graph edgedefault="directed">{nodes}{edges}</graph></graphml>')


def gxl():
    nodes = "".join(f'<node id="n{n}"><attr name="position"><tup>' +
                    "".join(f"<float>{c}</float>" for c in place) + "</tup></attr></node>"
                    for n, place in enumerate(PLACES))
    edges = "".join(f'<edge id="e{n}" from="n{a}" to="n{b}"><attr name="flow"><float>{FLOW[branch]}</float></attr>'
                    f'<attr name="resistance"><float>{branch + 0.5}</float></attr>'
                    '<attr name="radius"><float>2</float></attr></edge>' for n, (a, b, branch) in enumerate(EDGES))
    return f'<gxl><graph id="tree">{nodes}{edges}</graph></gxl>'


class Data(CommandLineTest):
    def data(self, path, *options):
        return {row["name"]: row for row in self.json("info", path, "--json", *options)["data"]}

    def check_data(self, path, pressure=True, *options):
        """As `info` sees it."""
        data = self.data(path, *options)
        self.assertEqual(set(data), {"pressure", "flow"} if pressure else {"flow"}, path)
        self.assertEqual({k: data["flow"][k] for k in ("of", "min", "max", "known", "unknown")},
                         {"of": "branches", "min": 3.5, "max": 12.0, "known": 3, "unknown": 0})
        if pressure:
            self.assertEqual({k: data["pressure"][k] for k in ("of", "min", "max", "known", "unknown")},
                             {"of": "points", "min": 60.0, "max": 90.5, "known": 4, "unknown": 1})
        rows = self.json("info", path, "--json", "--branches", *options)["branch_list"]
        flows = sorted(row["data"]["flow"] for row in rows)
        self.assertEqual(flows, sorted(FLOW))
        return rows

    def check_file(self, path, branches, points):
        """As another program sees a file that was written: values by branch, by place."""
        self.assertEqual(sorted(branches), sorted(FLOW), path)
        for place, value in points.items():
            expected = PRESSURE[PLACES.index(place)]
            self.assertTrue(value == expected or (math.isnan(value) and math.isnan(expected)), (path, place, value))
        self.assertEqual(len(points), 5)


    def rows(self, name):
        return png.Picture((self.folder / name).read_bytes()).rows


class Formats(Data):
    def sources(self):
        nodes = "id;pos_x;pos_y;pos_z;radius;pressure\n" + "".join(
            f"{n};{p[0]};{p[1]};{p[2]};{r};{text(v)}\n" for n, (p, r, v) in enumerate(zip(PLACES, RADII, PRESSURE)))
        edges = "id;node1id;node2id;flow\n" + "".join(
            f"{n};{a};{b};{FLOW[branch]}\n" for n, (a, b, branch) in enumerate(EDGES))
        self.write("pair_edges.csv", edges)
        return [self.write("own.json", own_json()), self.write("legacy.vtk", vtk_legacy()), self.write("grid.vtu", vtu()),
                self.write("graph.graphml", graphml()), self.write("pair_nodes.csv", nodes)]

    def test_data_is_kept_between_all_formats_that_store_it(self):
        for source in self.sources():
            rows = self.check_data(source)
            self.assertAlmostEqual(rows[0]["data"]["pressure"], (87.875 + 82.625) / 2)
            for ending in ("json", "vtp", "graphml", "csv"):
                out = self.folder / f"{source.stem.split('_')[0]}_to_nodes.{ending}" if ending == "csv" else \
                    self.folder / f"{source.stem.split('_')[0]}_to.{ending}"
                self.assertEqual(self.expect_done("convert", source, "-o", out).stderr, "")
                self.check_data(out)
                getattr(self, "look_at_" + ending)(out)

    def look_at_json(self, path):
        tree = json.loads(path.read_text())
        values = [NAN if v is None else v for v in tree["point_data"]["pressure"]]
        self.check_file(path, tree["branch_data"]["flow"],
                        {tuple(point[:3]): value for point, value in zip(tree["points"], values)})

    def look_at_vtp(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        arrays = {array.get("Name"): array for array in root.iter("DataArray")}

        def numbers(name):
            raw = base64.b64decode(arrays[name].text)
            return [v for v, in struct.iter_unpack("<d", raw[8:])]

        places = numbers("Points")
        self.check_file(path, numbers("flow"), {tuple(places[3 * n:3 * n + 3]): value
                                                for n, value in enumerate(numbers("pressure"))})

    def look_at_graphml(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        space = "{http://graphml.graphdrawing.org/xmlns}"
        points, flows = {}, {}
        for node in root.iter(space + "node"):
            values = {datum.get("key"): datum.text for datum in node.iter(space + "data")}
            points[tuple(float(values["v_" + axis]) for axis in "XYZ")] = float(values.get("v_pressure", "nan"))
        for edge in root.iter(space + "edge"):
            values = {datum.get("key"): datum.text for datum in edge.iter(space + "data")}
            flows[values["e_branch"]] = float(values["e_flow"])
        self.check_file(path, flows.values(), points)

    def look_at_csv(self, path):
        def rows(file):
            return list(csv.DictReader(file.read_text().splitlines(), delimiter=";"))

        nodes, edges = rows(path), rows(path.with_name(path.name.replace("to_nodes", "to_edges")))
        flows = {row["branch"]: float(row["flow"]) for row in edges}
        self.check_file(path, flows.values(), {tuple(float(row["pos_" + axis]) for axis in "xyz"):
                                               float(row["pressure"] or "nan") for row in nodes})

    def test_gxl(self):
        data = self.data(self.write("tree.gxl", gxl()))
        self.assertEqual(set(data), {"flow", "resistance"})
        self.assertEqual((data["resistance"]["min"], data["resistance"]["max"]), (0.5, 2.5))

    def test_vectors_and_text_are_left_out_with_a_note(self):
        notes = self.json("info", self.write("grid.vtu", vtu()), "--json")["assumptions"]
        self.assertTrue(any("left out" in note and "velocity" in note and "names" in note for note in notes), notes)

    def test_an_array_of_the_wrong_length_does_not_prevent_reading(self):
        path = self.write("short.vtk", vtk_legacy(pressure=PRESSURE[:3]))
        self.assertEqual(set(self.data(path)), {"flow"})
        self.assertTrue(any("pressure" in note for note in self.json("info", path, "--json")["assumptions"]))

    def test_formats_that_cannot_store_data_are_reported(self):
        source = self.write("own.json", own_json())
        for ending, left_out, kept in (("swc", "pressure, flow", set()), ("mrk.json", "flow", {"pressure"})):
            said = self.expect_done("convert", source, "-o", self.folder / f"bare.{ending}").stderr
            self.assertIn(f"left out: {left_out};", said)
            self.assertIn(".vtp", said)
            self.assertEqual(len(said.splitlines()), 1)
            self.assertEqual(set(self.data(self.folder / f"bare.{ending}")), kept)

    def test_reserved_names_are_kept(self):
        names = {"Label": [1, 2, 3, 4, 5], "a \"name\" <&; é": [1, 2, 3, 4, 5.5]}
        source = self.write("odd.json", own_json(point_data=names, branch_data={"GroupIds": [7, 8, 9], "length": [1, 2, 3]}))
        for ending, label, length in (("json", "Label", "length"), ("vtp", "Label_data", "length"),
                                      ("graphml", "Label_data", "length_data"), ("csv", "Label_data", "length_data")):
            out = self.folder / ("odd_to_nodes.csv" if ending == "csv" else f"odd_to.{ending}")
            self.expect_done("convert", source, "-o", out)
            data = self.data(out)
            self.assertEqual(set(data), {label, "a \"name\" <&; é", "GroupIds", length}, ending)
            self.assertEqual((data["GroupIds"]["min"], data["GroupIds"]["max"]), (7, 9))

    def test_damaged_data_in_own_formats_is_refused(self):
        for name, more, says in (
                ("length", {"point_data": {"p": [1, 2]}}, ["point_data.p", "2 values for 5 points"]),
                ("type", {"branch_data": {"p": [1, "a", 2]}}, ["branch_data.p[1]", "neither a number nor null"]),
                ("list", {"branch_data": [1]}, ["branch_data", "is not an object"]),
                ("many", {"branch_data": {str(n): FLOW for n in range(70)}}, ["more than 64 arrays"])):
            self.expect_failure("info", self.write(f"{name}.json", own_json(**more)), says=says)

    def test_too_many_arrays_in_other_formats_are_left_out(self):
        extra = "".join(f"\nSCALARS a{n} float 1\nLOOKUP_TABLE default\n1 2 3 4 5" for n in range(90))
        path = self.write("many.vtk", vtk_legacy(extra))
        self.assertEqual(len(self.data(path)), 64)
        self.assertTrue(any("beyond the first 64" in note for note in self.json("info", path, "--json")["assumptions"]))


    def test_info_lists_data_in_words(self):
        said = self.expect_done("info", self.write("own.json", own_json()), "--branches").stdout
        self.assertIn("pressure, of points: 60 to 90.5, 1 not known", said)
        self.assertIn("flow, of branches: 3.5 to 12", said)
        rows = [line.split() for line in said.splitlines() if line.strip()][-4:]
        self.assertEqual([row[-2:] for row in rows], [["pressure", "flow"], ["85.25", "12"], ["70", "8.5"], ["80", "3.5"]])


def swc(head="", cells=PRESSURE, more=""):
    parents = {b: a for a, b, _ in EDGES}
    return head + "".join(
        f"{n + 1} 0 {x} {y} {z} {RADII[n]} {parents[n] + 1 if n in parents else -1} {cell}{more}\n"
        for n, ((x, y, z), cell) in enumerate(zip(PLACES, cells)))


def vmv():
    rows = "".join(f"{n + 1}\t{x} {y} {z} {RADII[n]} {PRESSURE[n]} {n}\n" for n, (x, y, z) in enumerate(PLACES))
    strands = "".join(f"{n + 1} " + " ".join(str(p + 1) for p in points) + "\n" for n, points in enumerate(BRANCHES))
    return ("$PARAM_BEGIN\nNUM_VERTS 5\nNUM_STRANDS 3\nNUM_ATTRIB_PER_VERT 6\n$PARAM_END\n"
            f"$VERT_LIST_BEGIN\n{rows}$VERT_LIST_END\n$STRANDS_LIST_BEGIN\n{strands}$STRANDS_LIST_END\n")


def tre():
    tubes = "".join(
        f"ObjectType = Tube\nNDims = 3\nID = {n}\nPointDim = x y z r Intensity v1x v1y v1z\nNPoints = {len(points)}\n"
        "Points =\n" + "".join(f"{x} {y} {z} {RADII[p]} {PRESSURE[p]} 1 0 0\n" for p in points for x, y, z in [PLACES[p]])
        for n, points in enumerate(BRANCHES))
    return f"ObjectType = Scene\nNDims = 3\nNObjects = 3\n{tubes}"


def amira():
    def rows(values):
        return "".join(" ".join(map(str, v if isinstance(v, tuple) else (v,))) + "\n" for v in values)

    ends, along = [0, 2, 3, 4], [p for points in BRANCHES for p in points]
    blocks = (("VERTEX", "float[3] VertexCoordinates", [PLACES[p] for p in ends]),
              ("VERTEX", "int Component", [7, 7, 7, 7]),
              ("EDGE", "int[2] EdgeConnectivity", [(ends.index(b[0]), ends.index(b[-1])) for b in BRANCHES]),
              ("EDGE", "int NumEdgePoints", [len(b) for b in BRANCHES]), ("EDGE", "float flow", FLOW),
              ("POINT", "float[3] EdgePointCoordinates", [PLACES[p] for p in along]),
              ("POINT", "float thickness", [RADII[p] for p in along]),
              ("POINT", "double pressure", [PRESSURE[p] for p in along]),
              ("POINT", "float[2] pair", [(1, 2) for _ in along]))
    return ("# Avizo 3D ASCII 3.0\ndefine VERTEX 4\ndefine EDGE 3\ndefine POINT 7\n"
            'Parameters { ContentType "HxSpatialGraph" }\n' +
            "".join(f"{of} {{ {what} }} @{n}\n" for n, (of, what, _) in enumerate(blocks, 1)) +
            "".join(f"@{n}\n{rows(values)}" for n, (_, _, values) in enumerate(blocks, 1)))


def voreen():
    ends = [0, 2, 3, 4]
    nodes = [{"id": n, "pos": PLACES[p], "radius": RADII[p]} for n, p in enumerate(ends)]
    edges = [{"id": e, "node1": ends.index(b[0]), "node2": ends.index(b[-1]),
              "skeletonVoxels": [{"pos": PLACES[p], "avgDistToSurface": RADII[p], "volume": 8.5} for p in b[1:-1]],
              "pathProperties": {"avgRadiusAvg": 3.0, "length": 40, "flow": FLOW[e], "odd": [1]}}
             for e, b in enumerate(BRANCHES)]
    return json.dumps({"graph": {"nodes": nodes, "edges": edges}})


def markups():
    def curve(points):
        lists = {"Radius": RADII, "pressure": [number(p) for p in PRESSURE]}
        return {"type": "Curve", "coordinateSystem": "LPS",
                "controlPoints": [{"position": PLACES[p], "positionStatus": "defined"} for p in points],
                "measurements": [{"name": "length", "value": 4.0}] +
                                [{"name": k, "controlPointValues": [v[p] for p in points]} for k, v in lists.items()]}

    return json.dumps({"markups": [curve(points) for points in BRANCHES]})


class OtherFormats(Data):
    def ranges(self, name, content):
        return {key: (row["of"], row["min"], row["max"], row["known"], row["unknown"])
                for key, row in self.data(self.write(name, content)).items()}

    def test_swc(self):
        pressure = ("points", 60.0, 90.5, 4, 1)
        for head, name in (("", "column_8"), ("# id type x y z radius parent pressure\n", "pressure"),
                           ("# made by hand\n", "column_8"), ("id type x y z radius parent pressure\n", "pressure"),
                           ("n,t,x,y,z,r,pid,\"pressure\"\n", "pressure")):
            self.assertEqual(self.ranges("tree.swc", swc(head)), {name: pressure}, head)
        self.assertEqual(self.ranges("two.swc", swc(more=" 1")), {"column_8": pressure, "column_9": ("points", 1, 1, 5, 0)})
        self.assertEqual(self.ranges("short.swc", swc(cells=[1, 2, 3, "", ""])), {"column_8": ("points", 1, 3, 3, 2)})
        self.assertEqual(self.ranges("words.swc", swc(cells="abcde")), {})
        notes = self.json("info", "words.swc", "--json")["assumptions"]
        self.assertTrue(any("column_8" in note for note in notes), notes)

    def test_vmv(self):
        self.assertEqual(self.ranges("tree.vmv", vmv()), {"attribute_5": ("points", 60.0, 90.5, 4, 1),
                                                          "attribute_6": ("points", 0, 4, 5, 0)})
        self.expect_failure("info", self.write("word.vmv", vmv().replace("90.5", "high")), says=["word.vmv:7", "'high'"])

    def test_tubetk(self):
        self.assertEqual(self.ranges("tree.tre", tre()), {"Intensity": ("points", 60.0, 90.5, 4, 1)})

    def test_amira(self):
        self.assertEqual(self.ranges("tree.am", amira()), {
            "pressure": ("points", 60.0, 90.5, 4, 1), "flow": ("branches", 3.5, 12.0, 3, 0),
            "Component": ("points", 7, 7, 4, 1)})
        self.assertTrue(any("pair" in note for note in self.json("info", "tree.am", "--json")["assumptions"]))

    def test_voreen(self):
        self.assertEqual(self.ranges("tree.vvg", voreen()), {
            "volume": ("points", 8.5, 8.5, 1, 4), "flow": ("branches", 3.5, 12.0, 3, 0),
            "avgRadiusAvg": ("branches", 3.0, 3.0, 3, 0)})

    def test_markups_round_trip(self):
        expected = {"pressure": ("points", 60.0, 90.5, 4, 1)}
        self.assertEqual(self.ranges("tree.mrk.json", markups()), expected)
        self.expect_done("convert", "tree.mrk.json", "-o", "again.mrk.json")
        again = (self.folder / "again.mrk.json").read_text()
        self.assertEqual(self.ranges("copy.mrk.json", again), expected)
        document = json.loads(again)
        del document["ramus"]  # as another program would keep it
        self.assertEqual(self.ranges("other.mrk.json", json.dumps(document)), expected)


class Tables(Data):
    def tree(self):
        return self.write("own.json", own_json(point_data={}, branch_data={}))

    def test_a_table_is_joined_by_branch(self):
        for name, table in (("commas", "branch,flow\n1,8.5\n0,12\n2,3.5\n"), ("tabs", "flow\tid\n12\t0\n8.5\t1\n3.5\t2\n"),
                            ("semicolons", "number;flow;who\n2;3.5;a\n0;12;b\n1;8.5;c\n")):
            self.check_data(self.tree(), False, "--data", self.write(f"{name}.csv", table))
        row = self.data(self.tree(), "--data", self.write("some.csv", "branch,flow\n1,8.5\n0,NA\n"))["flow"]
        self.assertEqual((row["known"], row["unknown"], row["min"]), (1, 2, 8.5))

    def test_a_joined_table_is_written(self):
        table = self.write("flow.csv", "branch,flow\n1,8.5\n0,12\n2,3.5\n")
        self.expect_done("convert", self.tree(), "--data", table, "-o", self.folder / "joined.vtp")
        self.check_data(self.folder / "joined.vtp", False)

    def test_errors_of_tables(self):
        for name, table, says in (
                ("no", "branch,flow\n7,1\n", ["no.csv:2", "there is no branch 7 in a tree of 3"]),
                ("twice", "branch,flow\n1,1\n1,2\n", ["twice.csv:3", "branch 1 is there twice, first in line 2"]),
                ("words", "branch,flow\n1,much\n", ["no column of the table has numbers"]),
                ("bare", "1,2\n2,3\n", ["first line has numbers"]),
                ("short", "branch,flow\n1\n", ["short.csv:2", "1 cell", "2 columns"]),
                ("word_id", "branch,flow\nstem,1\n", ["word_id.csv:2", "'stem'", "is no branch"]),
                ("negative", "branch,flow\n-1,1\n", ["is no branch"]),
                ("comma", "branch;flow\n1;1,5\n", ["comma.csv:2", "decimal comma"]),
                ("empty", "", ["table is empty"]),
                ("head", "branch,flow\n", ["names no branch"])):
            self.expect_failure("info", self.tree(), "--data", self.write(f"{name}.csv", table), says=says)

    def test_a_session_stores_the_table_and_detects_changes(self):
        table = self.write("flow.csv", "branch,flow\n1,8.5\n0,12\n2,3.5\n")
        script = self.write("save.txt", "colour-by flow\ncolour-range 2,20\ncolour-log on\ncolour-map coolwarm\n"
                                        "save saved.ramus.json\n")
        self.expect_done("render", self.tree(), "--data", table, "--commands", script, "--size", "64x64", "-o", "a.png")
        session = json.loads((self.folder / "saved.ramus.json").read_text())
        self.assertEqual(session["reading"]["data"], "flow.csv")
        self.assertEqual(session["options"]["colour_by"], "file:flow")
        self.assertEqual(session["options"]["colour_range"], [2, 20])
        self.assertIs(session["options"]["colour_log"], True)
        self.assertEqual(session["options"]["colour_map"], "coolwarm")
        self.expect_done("render", "--session", "saved.ramus.json", "--size", "64x64", "-o", "b.png")
        self.assertEqual(self.rows("a.png"), self.rows("b.png"))
        table.write_text("branch,flow\n1,8.5\n")
        self.expect_failure("render", "--session", "saved.ramus.json", "--size", "64x64", "-o", "c.png",
                            says=["flow.csv", "has changed since the session was saved"])


class Reports(Data):
    def test_tables_of_branches_have_data(self):
        self.write("own.json", own_json(branch_data={"flow": [12, 8.5, NAN], "branch": [7, 8, 9]}).replace("NaN", "null"))
        self.write("report.txt", "select 0 2\nreport selection.csv selection\nreport page.html\n")
        self.expect_done("render", "own.json", "--commands", "report.txt", "--size", "64x64", "-o", "a.png")
        rows = list(csv.DictReader((self.folder / "selection.csv").read_text().splitlines()))
        self.assertEqual([[row[k] for k in ("branch", "flow", "pressure", "branch_data")] for row in rows],
                         [["0", "12", "85.25", "7"], ["2", "", "80", "9"]])
        self.assertNotIn("pressure", (self.folder / "page.html").read_text())


class Colours(Data):
    def picture(self, name, *options):
        self.expect_done("render", self.tree, "--size", "160x120", "-o", name, *options)
        return self.rows(name)

    def setUp(self):
        super().setUp()
        self.tree = self.write("own.json", own_json(branch_data={"flow": FLOW, "diameter": [1, 2, 3]}))

    def test_pictures_follow_the_colour_options(self):
        pictures = [self.picture(f"{n}.png", *options) for n, options in enumerate((
            (), ("--colour-by", "flow"), ("--colour-by", "pressure"), ("--colour-by", "diameter"),
            ("--colour-by", "file:diameter"), ("--colour-by", "flow", "--colour-map", "coolwarm"),
            ("--colour-by", "flow", "--colour-map", "grey"), ("--colour-by", "flow", "--colour-map", "plasma"),
            ("--colour-by", "flow", "--colour-range", "0,100"), ("--colour-by", "flow", "--colour-log", "on"),
            ("--colour-by", "flow", "--legend", "off"), ("--colour-by", "pressure", "--colour-range", "80,85"),
            ("--colour-by", "diameter", "--colour-range", "4,6")))]
        for n, one in enumerate(pictures):
            self.assertNotIn(one, pictures[:n], n)
        self.assertEqual(pictures[1], self.picture("same.png", "--colour-by", "file:flow", "--colour-range", "3.5,12"))
        self.assertEqual(pictures[1], self.picture("same.png", "--colour-by", "flow", "--colour-log", "off"))

    def test_the_picture_while_the_view_moves_has_the_same_colours(self):
        commands = self.write("colour.txt", "colour-by pressure\nlegend off\n")
        self.assertEqual(self.picture("a.png", "--commands", commands),
                         self.picture("b.png", "--colour-by", "pressure", "--legend", "off"))

    def test_invalid_colours_are_refused(self):
        for options, says, status in (
                (("--colour-by", "velocity"), ["there is no colouring \"velocity\"", "pressure, diameter, flow"], 1),
                (("--colour-by", "file:velocity"), ["velocity"], 1),
                (("--colour-range", "0,10", "--colour-log", "on"), ["cannot begin at 0"], 1),
                (("--colour-range", "10,0"), ["MIN,MAX"], 2), (("--colour-map", "rainbow"), ["rainbow"], 2),
                (("--legend", "maybe"), ["maybe"], 2)):
            self.expect_failure("render", self.tree, "-o", "no.png", *options, says=says,
                                status=status)


if __name__ == "__main__":
    unittest.main()
