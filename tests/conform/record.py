"""Makes the bags of recordings/ of the logs that the ROS 1 tests leave.

pytest --basetemp=DIR tests/ros1/test_examples.py tests/ros1/test_hard_cases.py
python -m tests.conform.record DIR
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from tests.conform.bagging import bag_of_log
from tests.forward.compiling import CASES, case_config
from tests.ros1.fidelity import subject

HERE = Path(__file__).parent / "recordings"
EXAMPLES = Path(__file__).parents[2] / "examples"


def main(folder: Path) -> None:
    """Writes a bag of each log, named after the model and the language of its nodes."""
    for log in sorted(folder.rglob("run.jsonl")):
        if log.parent.is_symlink():
            continue
        name, language = named(log)
        example = EXAMPLES / name / f"{name}.rebeca"
        case = CASES / f"{name}.rebeca"
        of = subject(example) if example.exists() else subject(case, case_config(case))
        path = HERE / f"{name}-{language}.bag"
        path.unlink(missing_ok=True)
        bag_of_log(log, of.observable, path)


def named(log: Path) -> tuple[str, str]:
    """The model and the language of the nodes of a log, as the run has noted them beside it."""
    noted = json.loads(log.with_name("subject.json").read_text(encoding="utf-8"))
    return noted["model"], noted["dialect"].removeprefix("ros1-")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
