"""Calls services, all at once where they are in one list, and prints the responses as JSON."""

import json
import sys
import threading
import time

import rospy
from services import srv


def ask(number: int, name: str, type_: str, values: list) -> None:
    """Calls one service; what it responds, and after how many seconds."""
    began = time.monotonic()
    rospy.wait_for_service(name, 20)
    response = rospy.ServiceProxy(name, getattr(srv, type_))(*values)
    said = {field: getattr(response, field) for field in response.__slots__}
    answers[number] = {"said": said, "after": time.monotonic() - began}


rospy.init_node("asker")
answers = {}
for group in json.loads(sys.argv[1]):
    threads = [
        threading.Thread(target=ask, args=(len(answers) + i, *call)) for i, call in enumerate(group)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
print(json.dumps([answers[i] for i in sorted(answers)]))
