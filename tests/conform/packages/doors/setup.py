from setuptools import setup

setup(
    name="doors",
    version="0.1.0",
    packages=["doors"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/doors"]),
        ("share/doors", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={"console_scripts": ["door = doors.door:main", "guard = doors.guard:main"]},
)
