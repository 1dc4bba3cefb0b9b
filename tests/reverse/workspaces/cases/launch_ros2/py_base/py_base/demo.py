import rclpy

from py_base.base import Unused


def main():
    rclpy.init()
    rclpy.spin(Unused())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
