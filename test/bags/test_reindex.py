"""A bag of a killed recorder is reindexed as documented, and old bags can be read."""

import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest
import yaml
from patience import PATIENCE
from recorded import PERIOD, PERIOD_NS

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.bags.reading import last_run, recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.bags.run_bag import RunBag
from vehicle_roll_sim.bags.writing import Bag
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.description import described

OF_A_BAG = re.compile(r".+_(\d+)\.mcap")
"""The names by which rosbag2's reindexer finds the files of a bag; it passes over all others."""
INFORMATION = "rosbag2_bagfile_information"


@pytest.fixture
def killed(tmp_path) -> Path:
    """The bag of a recorder that was killed right after it had kept 0.2 s of driving."""
    simulation = Simulation(preset())
    manoeuvre = STANDARD["step_steer"].for_vehicle(simulation.vehicle, simulation.options)
    bag = Bag(tmp_path / "alive" / "drive", "--bag")
    observer = RunBag(simulation, manoeuvre.commanded, bag, PERIOD_NS)
    bag.begin()
    run(simulation, manoeuvre.driver(), 0.2, command_period=PERIOD, observer=observer)
    bag.keep()
    shutil.copytree(tmp_path / "alive" / "drive", tmp_path / "drive")
    bag.close()
    return tmp_path / "drive"


def information(folder: Path) -> dict:
    return yaml.safe_load((folder / "metadata.yaml").read_text())[INFORMATION]


def reindex(folder: Path) -> None:
    """`ros2 bag reindex`, or what it does where it is not installed."""
    if shutil.which("ros2"):
        subprocess.run(
            ["ros2", "bag", "reindex", "-s", "mcap", folder], check=True, timeout=PATIENCE
        )
        return
    numbered = {int(m[1]): m[0] for f in folder.iterdir() if (m := OF_A_BAG.fullmatch(f.name))}
    assert numbered, "No storage files found for reindexing. Abort"
    names = [numbered[number] for number in sorted(numbered)]
    found = [contents(folder / name) for name in names]
    times = [time for _, of_file in found for time in of_file]
    counts = sum((each for each, _ in found), Counter())
    start, duration = min(times), max(times) - min(times)
    earlier = information(folder)
    for topic in earlier["topics_with_message_count"]:
        topic["message_count"] = counts[topic["topic_metadata"]["name"]]
    anew = earlier | {
        "relative_file_paths": names,
        "duration": {"nanoseconds": duration},
        "starting_time": {"nanoseconds_since_epoch": start},
        "message_count": len(times),
        "files": [],
        "custom_data": None,
    }
    (folder / "metadata.yaml").write_text(yaml.safe_dump({INFORMATION: anew}))


def contents(file: Path) -> tuple[Counter, list[int]]:
    """Messages by topic and the times of all of them (ns), as another library reads them."""
    from mcap.records import Channel, Message
    from mcap.stream_reader import StreamReader

    topics, counts, times = {}, Counter(), []
    with file.open("rb") as stream:
        for entry in StreamReader(stream).records:
            if isinstance(entry, Channel):
                topics[entry.id] = entry.topic
            elif isinstance(entry, Message):
                counts[topics[entry.channel_id]] += 1
                times.append(entry.log_time)
    return counts, times


def is_replayed(folder: Path) -> bool:
    (recorded,) = recorded_runs(folder)
    result = replay(recorded, described(recorded.description).simulation)
    return result.is_exact and result.is_complete


def test_a_bag_whose_recorder_was_killed_is_reindexed(killed):
    assert information(killed)["message_count"] == 2  # the descriptions, from before it began
    reindex(killed)
    told = information(killed)
    assert told["relative_file_paths"] == ["drive_0.mcap"]
    counts = {
        t["topic_metadata"]["name"]: t["message_count"] for t in told["topics_with_message_count"]
    }
    assert counts["/state"] == len(last_run(killed)[0].rows) == 21
    assert told["message_count"] == sum(counts.values())
    assert told["duration"]["nanoseconds"] == 200_000_000
    assert is_replayed(killed)


def test_a_bag_with_the_name_that_files_used_to_have_is_replayed(killed):
    (killed / "drive_0.mcap").rename(killed / "drive.mcap")
    metadata = killed / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("drive_0.mcap", "drive.mcap"))
    assert is_replayed(killed)
