"""Writes the diagnostic statuses of monitors as JSON lines: `diagnostics.py OUT`, under rospy."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticArray


def main() -> None:
    with Path(sys.argv[1]).open("w", encoding="utf-8", buffering=1) as out:

        def hear(diagnostics: DiagnosticArray) -> None:
            for status in diagnostics.status:
                if status.name.endswith(": run of the model"):
                    facts = {pair.key: pair.value for pair in status.values}
                    line = {"level": status.level, "message": status.message, "facts": facts}
                    out.write(json.dumps(line) + "\n")

        rospy.init_node("diagnostics", disable_signals=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, hear, queue_size=1000)
        print("ready", flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    main()
