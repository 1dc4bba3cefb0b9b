from setuptools import setup

setup(
    name="once",
    version="0.1.0",
    packages=["once"],
    entry_points={"console_scripts": ["once = once.once:main"]},
)
