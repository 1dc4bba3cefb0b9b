"""Calls services, those of one list at once; prints a line of JSON for each list."""

import json
import sys
import time
from importlib import import_module

import rclpy
from rclpy.node import Node

srv = import_module(f"{sys.argv[1]}.srv")


def ask_all(node: Node, calls: list) -> list:
    """Calls services at once; what each responds, and after how many seconds."""
    clients = [node.create_client(getattr(srv, type_), name) for name, type_, _ in calls]
    for client in clients:
        assert client.wait_for_service(60)
    began = time.monotonic()
    futures, ended = [], {}
    for client, (_, type_, values) in zip(clients, calls, strict=True):
        request = getattr(srv, type_).Request()
        for field, value in zip(request.get_fields_and_field_types(), values, strict=True):
            setattr(request, field, value)
        futures.append(client.call_async(request))
    while not all(f.done() for f in futures) and time.monotonic() < began + 60:
        rclpy.spin_once(node, timeout_sec=0.1)
        for number, future in enumerate(futures):
            if future.done():
                ended.setdefault(number, time.monotonic())
    answers = []
    for number, future in enumerate(futures):
        response = future.result() if future.done() else None
        fields = response.get_fields_and_field_types() if response is not None else ()
        said = {field: getattr(response, field) for field in fields}
        answers.append({"said": said, "after": ended.get(number, 1e9) - began})
    return answers


rclpy.init()
asker = rclpy.create_node("asker")
for group in json.loads(sys.argv[2]):
    print(json.dumps(ask_all(asker, group)), flush=True)
