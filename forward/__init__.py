"""From a Timed Rebeca model to a ROS package."""
