"""What expressions of Python stand for, and what calls of it ask of ROS."""
