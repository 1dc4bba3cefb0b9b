from setuptools import setup

setup(
    name="names",
    packages=["names"],
    entry_points={"console_scripts": ["sayer = names.names:say", "hearer = names.names:hear"]},
)
