"""Box plots of one quantity over all cases, as SVG that follows the colours of the page it stands in. By matplotlib."""

import io
import re

INK = "#010203"  # replaced by the colour of the page's text
WIDTH_IN, HEIGHT_IN = 4.4, 1.15


def available():
    try:
        import matplotlib  # noqa: F401, only asked for
    except ImportError:
        return False
    return True


def box_plot(values):
    """The box of quartiles, whiskers within 1.5 quartile distances, the mean as a diamond; cases beyond are links.

    values: pairs of a number and the folder of its case, at least two. The same values give the same text.
    """
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import cbook, pyplot

    style = {"svg.fonttype": "none", "svg.hashsalt": "ramus", "font.size": 12, "font.family": "sans-serif",
             "axes.edgecolor": INK, "xtick.color": INK, "text.color": INK, "axes.linewidth": 0.6}
    with matplotlib.rc_context(style):
        figure, axes = pyplot.subplots(figsize=(WIDTH_IN, HEIGHT_IN))
        (box,) = cbook.boxplot_stats([value for value, _ in values])
        line = {"color": INK, "linewidth": 1.1}
        axes.bxp([box], vert=False, widths=0.5, showfliers=False, showmeans=True, patch_artist=True,
                 boxprops={"facecolor": "#4c93c355", "edgecolor": INK, "linewidth": 1.1}, whiskerprops=line, capprops=line,
                 medianprops={"color": INK, "linewidth": 2.2},
                 meanprops={"marker": "D", "markersize": 5, "markerfacecolor": INK, "markeredgecolor": INK})
        beyond = [(value, folder) for value, folder in values if not box["whislo"] <= value <= box["whishi"]]
        if beyond:
            dots = axes.scatter([value for value, _ in beyond], [1] * len(beyond), s=34, facecolor="#d55e00cc", linewidth=0)
            dots.set_urls([f"#case-{folder}" for _, folder in beyond])
        axes.set_yticks([])
        axes.locator_params(axis="x", nbins=5)
        for side in ("left", "right", "top"):
            axes.spines[side].set_visible(False)
        figure.subplots_adjust(left=0.04, right=0.96, top=0.98, bottom=0.3)
        file = io.StringIO()
        figure.savefig(file, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
        pyplot.close(figure)
    drawing = file.getvalue()
    drawing = drawing[drawing.index("<svg"):]
    drawing = re.sub(r"<metadata>.*?</metadata>", "", drawing, flags=re.DOTALL)
    drawing = re.sub(r' id="[A-Za-z.]+_[0-9]+"', "", drawing)  # the same in every plot of a page
    return drawing.replace(INK, "currentColor")
