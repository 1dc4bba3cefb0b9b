from setuptools import setup

setup(
    name="python_twice",
    version="0.1.0",
    packages=["python_twice"],
    entry_points={
        "console_scripts": [
            "relay = python_twice.pass_on:main",
            "source = python_twice.first:main",
        ],
    },
)
