# SPDX-License-Identifier: Apache-2.0
"""Mistakes as fields."""

import pickle

import numpy
import pytest

import microswarm as ms
from conftest import SCENARIOS


def issues_of(call):
    with pytest.raises(ms.InputError) as caught:
        call()
    return caught.value.issues


def test_a_bad_value_has_key_value_and_limit(flight):
    (issue,) = issues_of(lambda: flight.set("obstacles.1.shape.radius_um", -3))
    assert issue == ("obstacles.1.shape.radius_um", "obstacles.1.shape.radius_um", issue.text, "-3", issue.limit)
    assert issue.limit.endswith("µm") and issue.limit in issue.text
    (issue,) = issues_of(lambda: flight.set("navigator.guidance", "backwards"))
    assert issue.value == "backwards" and issue.key == "navigator.guidance"
    (issue,) = issues_of(lambda: flight.set("navigator.sped_um_per_s", 3))
    assert "speed_um_per_s" in issue.limit.split(", ")


def test_each_mistake_of_a_file_has_its_place():
    text = "tick_s: 0\nnavigator: {type: radar, sped_um_per_s: 3}\nseed: a\n"
    issues = issues_of(lambda: ms.Scenario.from_text(text, SCENARIOS, "bad.yaml"))
    assert [(one.key, one.place, one.value) for one in issues] == [
        ("tick_s", "bad.yaml:1:9", "0"),
        ("navigator.sped_um_per_s", "bad.yaml:2:26", "3"),
        ("seed", "bad.yaml:3:7", "a"),
        ("map", "bad.yaml:1:1", ""),  # missing
    ]


def test_what_comes_out_when_it_is_opened_is_at_its_key(flight):
    flight.goal_um = (-500, 20)
    with pytest.raises(ms.InputError) as caught:
        ms.Session(flight)
    assert "--set" not in str(caught.value)
    assert caught.value.issues[0].key == "goal_um" and caught.value.issues[0].place == "goal_um"


def test_a_session_says_what_was_set(flight):
    session = ms.Session(flight)
    issues = issues_of(lambda: session.set("navigator", {"type": "radar", "typo": 1, "speed_um_per_s": -1}))
    assert [(one.key, one.place, one.value) for one in issues] == [
        ("navigator.typo", "", "1"),
        ("navigator.speed_um_per_s", "", "-1"),
    ]


def test_the_text_has_twenty_lines_and_the_issues_are_all_there():
    text = "".join(f"wrong_{i}: 1\n" for i in range(25))
    with pytest.raises(ms.InputError) as caught:
        ms.Scenario.from_text(text)
    assert len(caught.value.issues) >= 25
    lines = str(caught.value).splitlines()
    assert len(lines) == 21 and lines[-1] == f"and {len(caught.value.issues) - 20} more"
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.issues == caught.value.issues and str(again) == str(caught.value)


def test_a_message_alone_is_one_issue():
    (issue,) = issues_of(lambda: ms.Scenario.load("nowhere.yaml"))
    assert issue == ("", "nowhere.yaml", "cannot read: No such file or directory", "", "")
    (issue,) = issues_of(lambda: ms.plan("a map", (0, 0), (1, 1)))  # of the package itself
    assert "must be a Map" in issue.text


def test_a_mistake_of_a_file_has_the_file_as_its_place(tmp_path):
    damaged = tmp_path / "damaged.csv"
    damaged.write_text("1,2,3\n")
    for call, file in ((ms.Map.load, tmp_path / "nope.png"), (ms.Map.load, damaged), (ms.read_record, tmp_path / "nope.h5")):
        with pytest.raises(ms.InputError) as caught:
            call(str(file))
        (issue,) = caught.value.issues
        assert issue.place in (str(file), f"{file}:1") and str(file) not in issue.text
        assert str(caught.value) == f"{issue.place}: {issue.text}"


def test_a_record_is_no_scenario(tmp_path):
    file = tmp_path / "run.h5"
    file.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    for read in (ms.Scenario.load, ms.Session, ms.run):
        with pytest.raises(ms.InputError, match="run.h5: is a record, not text: read_record takes it"):
            read(file)


def test_settings_that_are_planned_with_speak_no_command_line():
    walls = ms.Map.from_walls((0, 0, 100, 100))
    with pytest.raises(ms.InputError) as caught:
        ms.plan(walls, (10, 10), (90, 90), planner="a_star", spacing=-1)
    assert "--set" not in str(caught.value) and caught.value.issues[0].key.startswith("planner.")


@pytest.mark.parametrize(
    "call, name, value, limit",
    [
        (lambda: ms.run("scenarios/first_flight.yaml", seed="x"), "seed", "'x'", "a whole number from 0 to 18446744073709551615"),
        (lambda: ms.run("scenarios/first_flight.yaml", trial=-1), "trial", "-1", None),
        (lambda: ms.Map.from_image(numpy.zeros((4, 4), numpy.uint8), 1, free="grey"), "free", "'grey'", "'bright' or 'dark'"),
    ],
)
def test_an_argument_is_refused_by_name_value_and_limit(call, name, value, limit):
    with pytest.raises(ms.InputError) as caught:
        call()
    (issue,) = caught.value.issues
    assert (issue.key, issue.place, issue.value) == (name, name, value)
    assert issue.limit and limit in (None, issue.limit)
    assert issue.text == str(caught.value) == f"{name} is {value}, must be {issue.limit}"
