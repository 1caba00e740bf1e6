"""Episode files come back as they were written, and whatever else is read is refused in one sentence."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from recorded_tests import made_episode, made_test

from sldr_core.episodes import RecordedTest, episodes_file, read_episodes, write_episodes
from sldr_core.errors import BadFile


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / episodes_file(12)
    write_episodes(path, made_test())
    return path


def assert_same(ours: RecordedTest, theirs: RecordedTest) -> None:
    assert ours.origin == theirs.origin
    assert len(ours.episodes) == len(theirs.episodes)
    for one, other in zip(ours.episodes, theirs.episodes, strict=True):
        for (name, value), expected in zip(asdict(one).items(), asdict(other).values(), strict=True):
            if isinstance(expected, np.ndarray):
                assert value.dtype == expected.dtype, name
                np.testing.assert_array_equal(value, expected, err_msg=name)
            else:
                assert value == expected, name


def test_a_test_comes_back_to_the_last_bit(path: Path) -> None:
    assert path.name == "episodes-epoch-0012.npz"
    assert_same(read_episodes(path), made_test())


def test_a_generator_goes_on_from_the_state_that_was_kept(path: Path) -> None:
    rng = np.random.default_rng()
    rng.bit_generator.state = read_episodes(path).episodes[1].rng_state

    assert rng.random() == np.random.default_rng(1).random()


def test_equal_episodes_make_equal_bytes(path: Path) -> None:
    before = path.read_bytes()
    write_episodes(path, made_test())

    assert path.read_bytes() == before


def test_episodes_without_parts_keep_their_empty_columns(tmp_path: Path) -> None:
    none = np.empty((4, 0, 0), dtype=np.float32)
    bare = made_episode(
        wanted=none, induced=none, reward=np.zeros((4, 1), np.float32), value=np.zeros((4, 1), np.float32)
    )
    test = made_test(bare, streams=("task",))
    test = replace(test, origin=replace(test.origin, parts=()))
    write_episodes(tmp_path / "bare.npz", test)

    assert_same(read_episodes(tmp_path / "bare.npz"), test)


def test_every_cut_is_told_in_one_sentence(path: Path) -> None:
    whole = path.read_bytes()
    for length in (0, 1, 100, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:length])
        with pytest.raises(BadFile, match="cut short, damaged or no file of recorded episodes") as caught:
            read_episodes(path)
        assert "\n" not in str(caught.value)


def test_a_flipped_bit_is_found(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(bytes(content))

    with pytest.raises(BadFile):
        read_episodes(path)


@pytest.mark.parametrize("content", [b"not an archive", b"\x80\x04N.", b"PK\x05\x06" + bytes(18)])
def test_foreign_files_are_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "foreign.npz").write_bytes(content)

    with pytest.raises(BadFile, match="foreign"):
        read_episodes(tmp_path / "foreign.npz")


def test_a_lone_array_and_a_pickle_are_refused(tmp_path: Path) -> None:
    with (tmp_path / "array.npz").open("wb") as file:
        np.save(file, np.zeros(3))
    np.savez(tmp_path / "pickle.npz", header=np.array({"kind": "episodes"}, dtype=object))

    for name in ("array.npz", "pickle.npz"):
        with pytest.raises(BadFile, match=name):
            read_episodes(tmp_path / name)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match=r"There is no file .*gone\.npz"):
        read_episodes(tmp_path / "gone.npz")


def rewrite(path: Path, **changes: np.ndarray) -> None:
    """Write a file again with other arrays."""
    with np.load(path) as archive:
        arrays = {name: archive[name] for name in archive.files}
    with path.open("wb") as file:
        np.savez(file, **{**arrays, **changes})


def test_a_newer_format_asks_for_an_update(path: Path) -> None:
    with np.load(path) as archive:
        header = json.loads(str(archive["header"][()]))
    rewrite(path, header=np.array(json.dumps({**header, "format": 2})))

    with pytest.raises(BadFile, match="is of format 2 and this version reads format 1"):
        read_episodes(path)


@pytest.mark.parametrize(
    "changes",
    [
        {"qpos": np.zeros((2, 4, 22))},
        {"obs": np.zeros((2, 5, 25))},
        {"reward": np.zeros((2, 4, 3), np.float32)},
        {"contact": np.zeros((2, 5, 2), bool)},
        {"action": np.zeros((1, 4, 4), np.float32)},
        {"header": np.array("{}")},
    ],
)
def test_arrays_that_do_not_fit_together_are_refused(changes: dict[str, np.ndarray], path: Path) -> None:
    rewrite(path, **changes)

    with pytest.raises(BadFile):
        read_episodes(path)


def test_a_test_without_episodes_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError):
        write_episodes(tmp_path / "none.npz", replace(made_test(), episodes=()))


def test_a_summary_tells_the_worst_q_of_all_its_streams() -> None:
    streams = ("task", "sldr/rotation", "sldr/translation", "rnd")
    reward = np.array(
        [[-1.0, -0.1, -0.2, -9.0], [-1.0, -0.3, -0.9, 0.0], [0.0, -0.9, -0.2, 0.0], [0.0, 0.0, 0.0, 0.0]], np.float32
    )
    episode = made_episode(3, reward=reward, success=np.array([False, False, True, True, True]), tag="success")

    summary = made_test(episode, streams=streams).summaries()[0]

    assert (summary.epoch, summary.index, summary.length, summary.success) == (12, 3, 4, True)
    assert summary.task_return == -2.0
    assert (summary.worst_q, summary.worst_q_step) == (pytest.approx(-0.9), 1)


def test_without_sldr_there_is_no_worst_q() -> None:
    summary = made_test(streams=("task", "rnd")).summaries()[0]

    assert (summary.worst_q, summary.worst_q_step) == (None, None)
