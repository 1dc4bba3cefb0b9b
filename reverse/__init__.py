"""From the code of a ROS package to a Timed Rebeca model."""
