"""A person may let a training start below its gate; its config and checkpoint stay what they were."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_training import TINY, save_untrained_model

from sldr_core.config import config_hash
from sldr_core.errors import LocomotionMissing
from sldr_core.presets import make_config
from sldr_core.training import DirectoryRecorder, train


def test_a_model_below_the_gate_is_taken_only_when_the_gate_is_waived(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt")
    config = make_config("ShortPush", "manipulation", "her-sldr", 0, "smoke", {**TINY, "sldr": {"gate": 0.98}})
    before = config_hash(config)

    with pytest.raises(LocomotionMissing, match=r"below the gate of 98\.0%"):
        train(config, DirectoryRecorder(tmp_path / "run"), (model,))
    result = train(config, DirectoryRecorder(tmp_path / "run"), (model,), gate_waived=True)

    assert result.finished
    assert config_hash(config) == before
