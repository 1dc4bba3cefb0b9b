import rclpy
from tools.console import Console


def main():
    rclpy.init()
    rclpy.spin(Console())
