"""The fields of message types that tell people how a node does, and the names of their constants.

No node of a model is sent any of these: the readers of messages do not ask for them.
"""

from __future__ import annotations

_MARKER = (
    *("header std_msgs/Header", "ns string", "id int32", "type int32", "action int32"),
    *("pose geometry_msgs/Pose", "scale geometry_msgs/Vector3", "color std_msgs/ColorRGBA"),
    *("lifetime duration", "frame_locked bool", "points geometry_msgs/Point[]"),
    *("colors std_msgs/ColorRGBA[]", "text string", "mesh_resource string"),
    "mesh_use_embedded_materials bool",
)

# By type the fields, `name type`, as in `common_messages`.
TOLD: dict[str, str] = {
    "diagnostic_msgs/KeyValue": "key string, value string",
    "diagnostic_msgs/DiagnosticStatus": (
        "level byte, name string, message string, hardware_id string,"
        " values diagnostic_msgs/KeyValue[]"
    ),
    "diagnostic_msgs/DiagnosticArray": (
        "header std_msgs/Header, status diagnostic_msgs/DiagnosticStatus[]"
    ),
    "visualization_msgs/Marker": ", ".join(_MARKER),
    "visualization_msgs/MarkerArray": "markers visualization_msgs/Marker[]",
}
CONSTANTS: dict[str, frozenset[str]] = {
    "diagnostic_msgs/DiagnosticStatus": frozenset({"OK", "WARN", "ERROR", "STALE"}),
    "visualization_msgs/Marker": frozenset(
        {
            *("ADD", "ARROW", "CUBE", "CUBE_LIST", "CYLINDER", "DELETE", "DELETEALL"),
            *("LINE_LIST", "LINE_STRIP", "MESH_RESOURCE", "MODIFY", "POINTS", "SPHERE"),
            *("SPHERE_LIST", "TEXT_VIEW_FACING", "TRIANGLE_LIST"),
        }
    ),
}
