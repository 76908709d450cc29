# The steps of one case. Every step ends well and leaves a record, also of a failure, so that a broken case stops no
# other. `key` is a digest of what the step depends on: the bytes of the input, the options, the version of ramus. A step
# runs again when its key changes. The input itself is no input of a rule: snakemake would read {x} in its name as a
# wildcard, and its date would count.
PYTHON = sys.executable
RUN_STEP = str(Path(workflow.basedir) / "scripts" / "case_step.py")
STEP = "{PYTHON:q} {RUN_STEP:q} {rule} {wildcards.case} {params.key} {threads}"


def key_of(step):
    return lambda wildcards: cohort.key_of(config, CASES[wildcards.case], step)


def before(step):
    """The record of the step before. So the steps of a case are connected, and a cluster gets them as one job."""

    def record(wildcards):
        case = CASES[wildcards.case]
        first = cohort.step_before(case, step)
        return cohort.record_path(case, first) if first else []

    return record


rule skeletonize:
    output: "cases/{case}/skeletonize.json"
    params: key=key_of("skeletonize")
    threads: config["threads"]
    group: "case"
    shell: STEP

rule measure:
    input: before("measure")
    output: "cases/{case}/measure.json"
    params: key=key_of("measure")
    threads: config["threads"]
    group: "case"
    shell: STEP

rule validate:
    input: before("validate")
    output: "cases/{case}/validate.json"
    params: key=key_of("validate")
    threads: config["threads"]
    group: "case"
    shell: STEP

rule picture:
    input: before("picture")
    output: "cases/{case}/picture.json"
    params: key=key_of("picture")
    threads: config["threads"]
    group: "case"
    shell: STEP
