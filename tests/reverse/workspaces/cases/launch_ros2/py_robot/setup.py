from setuptools import setup

setup(
    name="py_robot",
    version="0.1.0",
    packages=["py_robot"],
    entry_points={"console_scripts": ["robot = py_robot.robot:main"]},
)
