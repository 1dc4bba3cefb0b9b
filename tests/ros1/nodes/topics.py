"""Makes tests/conform/recordings/thermostat.jsonl: the nodes of packages/thermostat.

/usr/bin/python3 tests/ros1/nodes/topics.py SECONDS >LOG, beside a roscore.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from pathlib import Path
from threading import Lock

import rospy
from std_msgs.msg import Bool, Int32

SOURCES = Path(__file__).parents[2] / "rebsync/conform/packages/thermostat/src"
TOPICS = {"/temperature": Int32, "/heat": Bool, "/power": Int32}


def main(seconds: float) -> None:
    """Subscribes, starts the nodes, and tells temperatures at odd times."""
    lock = Lock()

    def hear(message: Bool | Int32, topic: str) -> None:
        node = message._connection_header["callerid"]
        line = {"topic": topic, "stamp": time.time(), "data": {"data": message.data}, "node": node}
        with lock:
            print(json.dumps(line), flush=True)

    rospy.init_node("sensor")
    for topic, type_ in TOPICS.items():
        rospy.Subscriber(topic, type_, hear, topic)
    temperature = rospy.Publisher("/temperature", Int32, queue_size=10)
    scripts = [SOURCES / "thermostat.py", SOURCES / "heater.py"]
    nodes = [subprocess.Popen([sys.executable, str(script)]) for script in scripts]
    end = time.time() + seconds
    while time.time() < end:
        time.sleep(random.uniform(0.6, 1.3))
        temperature.publish(Int32(random.randint(14, 26)))
    for node in nodes:
        node.terminate()


if __name__ == "__main__":
    main(float(sys.argv[1]))
