from setuptools import setup

setup(
    name="lamp",
    version="0.1.0",
    packages=["lamp"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/lamp"]),
        ("share/lamp", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={"console_scripts": ["lamp = lamp.lamp:main", "switch = lamp.switch:main"]},
)
