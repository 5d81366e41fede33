"""Where the work is done."""

from typing import Annotated, TypeAlias

from midrib.cli.options.choices import Engine
from midrib.cli.options.panels import of_engine

__all__ = ["EngineOption", "PartRows", "Scheduler", "SparkMaster", "Workers"]

EngineOption: TypeAlias = Annotated[
    Engine,
    of_engine(
        "--engine",
        metavar="NAME",
        help="local: on this machine; dask, spark: on a cluster that sees IN and OUT under the "
        "same names.",
    ),
]
Workers: TypeAlias = Annotated[
    int | None,
    of_engine(
        "--workers",
        metavar="N",
        min=1,
        help="Processes on this machine, of one thread each; one process with a thread for each "
        "core unless you say otherwise, of Dask a process for each core.",
    ),
]
Scheduler: TypeAlias = Annotated[
    str | None,
    of_engine("--scheduler", metavar="ADDRESS", help="Of Dask: tcp://host:8786; one here if none."),
]
SparkMaster: TypeAlias = Annotated[
    str | None,
    of_engine("--master", metavar="URL", help="Of Spark: spark://host:7077; local[*] if none."),
]
PartRows: TypeAlias = Annotated[
    int,
    of_engine(
        "--part-rows", metavar="N", min=1, help="Features of a part at most, if OUT is a folder."
    ),
]
