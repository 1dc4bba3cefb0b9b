from setuptools import setup

setup(
    name="tools",
    packages=["tools"],
    entry_points={"console_scripts": ["console = tools.main:main"]},
)
