"""rebsync keeps Timed Rebeca models and the ROS code made from them in step."""

__version__ = "0.1.0"
