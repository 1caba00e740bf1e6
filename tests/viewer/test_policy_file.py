"""A policy file is followed: newer content replaces older, and what cannot be read does not."""

from __future__ import annotations

import os

import pytest

from sldr_core.errors import BadFile
from worker.viewer.policy_file import PolicyFile


def test_a_changed_file_is_loaded_when_asked(tmp_path, write_policy_file):
    path = tmp_path / "policy-newest.pt"
    write_policy_file(path, cycle=2)
    policy_file = PolicyFile(path)
    write_policy_file(tmp_path / "next.pt", cycle=8)
    os.replace(tmp_path / "next.pt", path)
    assert policy_file.policy.epoch == 1
    assert policy_file.refresh()
    assert policy_file.policy.epoch == 4


def test_a_corrupt_newer_file_is_named_and_the_old_policy_stays(tmp_path, write_policy_file):
    path = tmp_path / "policy-newest.pt"
    write_policy_file(path)
    policy_file = PolicyFile(path)
    path.write_bytes(b"not a policy")
    assert not policy_file.refresh()
    assert policy_file.policy.epoch == 1
    assert policy_file.problem is not None
    assert str(path) in policy_file.problem


def test_a_corrupt_first_file_is_refused(tmp_path):
    (tmp_path / "policy-newest.pt").write_bytes(b"not a policy")
    with pytest.raises(BadFile):
        PolicyFile(tmp_path / "policy-newest.pt")
