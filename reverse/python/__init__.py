"""Code of nodes in Python, of both generations of ROS, and of Python 2 as well as 3."""
