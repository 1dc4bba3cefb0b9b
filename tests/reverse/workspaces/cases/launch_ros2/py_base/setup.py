from setuptools import setup

setup(
    name="py_base",
    version="0.1.0",
    packages=["py_base"],
    entry_points={"console_scripts": ["demo = py_base.demo:main"]},
)
