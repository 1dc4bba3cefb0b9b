"""What the code asks of ROS."""
