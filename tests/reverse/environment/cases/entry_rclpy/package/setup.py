from setuptools import setup

setup(
    name="entry",
    version="0.1.0",
    packages=["entry"],
    entry_points={"console_scripts": ["entry = entry.entry:main"]},
)
