"""Build of the ament_python package; versions are pinned in requirements/."""

from glob import glob

from setuptools import find_packages, setup

NAME = "vehicle_roll_sim"
SHARE = f"share/{NAME}"
DOCS = ("docs", *(f"docs/{name}" for name in ("tutorials", "notebooks", "reference")))
CPP = "examples/lqr_roll_bar_cpp"
CPP_EXAMPLE = (CPP, f"{CPP}/src", f"{CPP}/include/lqr_roll_bar_cpp")
EXAMPLES = (
    *("active_roll_bar", "lqr_roll_bar", "rear_steering", "roll_braking", "rollover_mpc"),
    *("rollover_warning", "stability_control", "yaw_control"),
)

setup(
    name=NAME,
    version="0.1.0",
    description="Real-time vehicle roll simulation with 14 degrees of freedom, for ROS 2",
    license="Apache-2.0",
    author="The vehicle_roll_sim authors",
    maintainer="The vehicle_roll_sim maintainers",
    maintainer_email="vehicle-roll-sim@example.org",
    url="https://example.org/vehicle_roll_sim",
    classifiers=[f"Programming Language :: Python :: 3.{minor}" for minor in (11, 12, 13, 14)],
    python_requires=">=3.11",
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    package_data={
        f"{NAME}.control_laws": ["*.yaml"],
        f"{NAME}.paper": ["published/data/*.yaml"],
        f"{NAME}.vehicle": ["presets/*.yaml", "presets/*.tir", "presets/*.csv"],
        f"{NAME}.viewer": ["web/*.*", "web/three/*"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (SHARE, ["package.xml", "LICENSE", "CHANGELOG.rst", *sorted(glob("*.md"))]),
        *((f"{SHARE}/{folder}", sorted(glob(f"{folder}/*.*"))) for folder in DOCS),
        (f"{SHARE}/presets", sorted(glob(f"{NAME}/vehicle/presets/*"))),
        (f"{SHARE}/examples", sorted(glob("examples/*.*"))),
        (f"{SHARE}/examples/studies", sorted(glob("examples/studies/*"))),
        *((f"{SHARE}/{folder}", sorted(glob(f"{folder}/*.*"))) for folder in CPP_EXAMPLE),
        (f"{SHARE}/msg_examples", sorted(glob("msg_examples/*.*"))),
        (f"{SHARE}/launch", sorted(glob(f"{NAME}/launch/*.launch.py"))),
        (f"{SHARE}/config", sorted(glob(f"{NAME}/config/*"))),
        (f"{SHARE}/policies", sorted(glob("policies/*.xml"))),
    ],
    install_requires=[
        "setuptools",
        "numpy>=1.26,<3",
        "scipy>=1.11.1",
        "PyYAML>=6",
        "tqdm>=4.60",
        "matplotlib>=3.6",
    ],
    extras_require={
        "compiled": ["numba>=0.59"],
        "recorder": ["rosbags>=0.11.6,<0.12"],
        "control": ["control>=0.10"],
        "gym": ["gymnasium>=1.1"],
        "logs": ["pint>=0.24"],
        "mdf": ["asammdf>=8"],
        "crg": ["pyopencrg>=0.2.2,<0.3"],
        "pandas": ["pandas>=2"],
        "studies": ["pyarrow>=14"],
        "cluster": ["distributed>=2026.8"],
        "film": ["selenium>=4.20", "pillow>=9.1"],
        "validation": ["mujoco>=3.2"],
        "test": [
            "pytest>=7.4",
            "pytest-xdist>=3.5",
            "hypothesis>=6.98",
            "mujoco>=3.2",
            "mcap-ros2-support",
            "selenium>=4.20",
        ],
    },
    zip_safe=False,
    entry_points={
        "console_scripts": [
            f"vehicle_roll_sim = {NAME}.command_line.entry:main",
            f"offline = {NAME}.command_line.entry:main",  # short after `ros2 run vehicle_roll_sim`
            f"simulator = {NAME}.ros.executables:simulator",
            f"manoeuvre = {NAME}.ros.executables:manoeuvre",
            f"recorder = {NAME}.ros.executables:recorder",
            f"live_view = {NAME}.ros.executables:live_view",
            f"demo = {NAME}.ros.executables:demo",
            f"compare = {NAME}.ros.executables:compare",
            f"score = {NAME}.ros.executables:score",
            *(f"{name} = {NAME}.examples.executables:{name}" for name in EXAMPLES),
        ],
    },
)
