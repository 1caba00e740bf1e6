"""A batch that is worked through in slices teaches and pays what the whole batch at once does."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from small_training import TIMINGS, collected_parts, save_untrained_model, tiny_config
from torch import Tensor, nn

from sldr_core.config import Phase
from sldr_core.nets import descent, precision
from sldr_core.nets.descent import SLICE_ROWS, descend, held, slices_of
from sldr_core.nets.precision import learner_precision
from sldr_core.training.cycle import learn

CPU = torch.device("cpu")
PAPER_BATCH = 4864
ROWS = 50
UNEVEN = [slice(0, 20), slice(20, 27), slice(27, 50)]


@pytest.mark.parametrize("rows", [1, SLICE_ROWS, SLICE_ROWS + 1, 5000, PAPER_BATCH])
def test_slices_cover_every_row_once_and_are_nearly_of_one_length(rows: int) -> None:
    slices = slices_of(rows, CPU)

    assert [row for part in slices for row in range(rows)[part]] == list(range(rows))
    lengths = [part.stop - part.start for part in slices]
    assert max(lengths) <= SLICE_ROWS
    assert max(lengths) - min(lengths) <= 1


def test_a_gpu_is_given_the_whole_batch() -> None:
    assert slices_of(PAPER_BATCH, torch.device("cuda")) == [slice(0, PAPER_BATCH)]


def test_a_processor_is_given_the_whole_batch_while_it_computes_in_bfloat16(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "_has_instructions", lambda: True)

    with learner_precision(CPU, bfloat16=True):
        assert slices_of(PAPER_BATCH, CPU) == [slice(0, PAPER_BATCH)]
    with learner_precision(CPU, bfloat16=False):
        assert len(slices_of(PAPER_BATCH, CPU)) == 4


def test_gradients_pass_through_what_is_held() -> None:
    learning, judging = nn.Linear(3, 2), nn.Linear(2, 1)

    with held(judging):
        value = judging(learning(torch.ones(3))).sum()
    value.backward()

    assert all(parameter.grad is not None for parameter in learning.parameters())
    assert all(parameter.grad is None and parameter.requires_grad for parameter in judging.parameters())


@pytest.mark.parametrize("slices", [[slice(0, ROWS)], UNEVEN])
def test_a_step_over_slices_is_the_step_of_the_mean_over_the_batch(slices: list[slice]) -> None:
    generator = torch.Generator().manual_seed(0)
    x, wanted = torch.randn((ROWS, 3), generator=generator), torch.randn((ROWS, 1), generator=generator)
    stepped, plain = nn.Linear(3, 1), nn.Linear(3, 1)
    plain.load_state_dict(stepped.state_dict())
    plain_optimiser = torch.optim.SGD(plain.parameters(), lr=0.1)

    def loss(rows: slice) -> Tensor:
        return (stepped(x[rows]) - wanted[rows]).square().mean()

    optimiser = torch.optim.SGD(stepped.parameters(), lr=0.1)
    for _ in range(3):
        told = descend(loss, slices, stepped, optimiser)
        plain_optimiser.zero_grad()
        whole = (plain(x) - wanted).square().mean()
        whole.backward()
        plain_optimiser.step()
        torch.testing.assert_close(told, whole.detach())

    for ours, theirs in zip(stepped.parameters(), plain.parameters(), strict=True):
        torch.testing.assert_close(ours, theirs)


def test_nothing_but_what_learns_gets_a_gradient() -> None:
    learning, judging = nn.Linear(3, 2), nn.Linear(2, 1)
    x = torch.ones((ROWS, 3))

    descend(lambda rows: judging(learning(x[rows])).mean(), UNEVEN, learning, torch.optim.SGD(learning.parameters()))

    assert all(parameter.grad is None for parameter in judging.parameters())


@pytest.mark.parametrize(
    ("phase", "method"), [("locomotion", "her"), ("manipulation", "her-sldr"), ("manipulation", "her-rnd")]
)
def test_whatever_learns_and_pays_does_in_slices_what_it_does_at_once(
    phase: Phase, method: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    models = (save_untrained_model(tmp_path / "model.pt"),) if method == "her-sldr" else ()
    told: list[dict[str, float]] = []
    for slice_rows in (SLICE_ROWS, 5):
        monkeypatch.setattr(descent, "SLICE_ROWS", slice_rows)
        directory = tmp_path / str(slice_rows)
        directory.mkdir()
        parts = collected_parts(tiny_config(phase, method), directory, models)
        metrics = learn(parts, 0, lambda: None)
        told.append({name: value for name, value in metrics.items() if not name.startswith(TIMINGS)})

    whole, in_slices = told
    assert in_slices == pytest.approx(whole, rel=1e-4, abs=1e-6)
