# The tables of all cases, and the page.
rule tables:
    input: RECORDS
    output:
        "tables/cases.csv",
        "tables/branches.csv",
        "tables/statistics.csv",
        "tables/failed.csv",
        "tables/outcome.json",
    params:
        key=cohort.digest([[case["name"], case["folder"]] for case in config["cases"]]),
        script=str(Path(workflow.basedir) / "scripts" / "tables.py"),
    shell: "{PYTHON:q} {params.script:q}"

rule page:
    input: rules.tables.output
    output: "index.html"
    params:
        script=str(Path(workflow.basedir) / "scripts" / "page.py"),
    shell: "{PYTHON:q} {params.script:q}"
