"""A learner in bfloat16 computes what instructions for it would, and leaves no product to torch's slow code."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch
from plain_layers import linear_and_rectify
from small_training import assert_same_training, run, save_untrained_model, tiny_config
from torch import Tensor
from torch.utils._python_dispatch import TorchDispatchMode

from sldr_core.agent import DdpgAgent, InverseLearner
from sldr_core.agent.losses import actor_loss
from sldr_core.config import AgentConfig, RndConfig, SldrConfig, TrainConfig, find_task
from sldr_core.nets import fused, precision
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.nets.mlp import Mlp, MlpStack
from sldr_core.nets.precision import learner_precision
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import part_view, view_of
from sldr_core.streams import RndStream, SldrStream

CPU = torch.device("cpu")
PUSH = find_task("FetchPush")
VIEW = view_of(PUSH, "manipulation")
SMALL = AgentConfig(hidden_sizes=(16, 16), learning_rate=1e-2)
PRODUCTS = ("mm", "addmm", "bmm", "baddbmm", "_linear_pointwise")
SPACING = 2.0**-8
"""How far bfloat16 numbers lie apart at most, in parts of themselves; rounding errs by half of that at most."""


@pytest.fixture
def without_instructions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "_has_instructions", lambda: False)


class Products(TorchDispatchMode):
    """Note in which precision products arrive at torch."""

    def __init__(self) -> None:
        super().__init__()
        self.dtypes: list[torch.dtype] = []

    def __torch_dispatch__(
        self, func: Any, types: Any, args: tuple[Any, ...] = (), kwargs: dict[str, Any] | None = None
    ) -> Any:
        if func.overloadpacket.__name__ in PRODUCTS:
            self.dtypes.append(args[0].dtype)
        return func(*args, **(kwargs or {}))


def batch_of(size: int = 24) -> Transitions:
    generator = torch.Generator().manual_seed(1)
    obs, next_obs = (torch.randn(size, 25, generator=generator) for _ in range(2))
    goal, action = torch.randn(size, 3, generator=generator), torch.rand(size, 4, generator=generator)
    induced = {"sldr/object0/induced_action": torch.rand(size, 7, generator=generator)}
    return Transitions(obs, next_obs, goal, action, -torch.rand(size, generator=generator), induced)


def agent_in_bfloat16() -> DdpgAgent:
    generator = torch.Generator().manual_seed(0)
    return DdpgAgent(VIEW, 4, ("task", "rnd"), (1.0, 0.5), SMALL, generator, CPU, autocast=True)


def update_of_the_agent(batch: Transitions, tmp_path: Path) -> None:
    agent_in_bfloat16().update(batch, torch.stack([batch.reward, batch.reward]))


def update_of_the_inverse_model(batch: Transitions, tmp_path: Path) -> None:
    InverseLearner(25, 4, SMALL, torch.Generator(), CPU, autocast=True).update(batch)


def reward_and_lesson_of_rnd(batch: Transitions, tmp_path: Path) -> None:
    stream = RndStream(RndConfig(outputs=4), SMALL, VIEW, torch.Generator(), CPU, autocast=True)
    stream.observe(batch.obs[None], batch.goal[None])
    stream.reward(batch)
    stream.learn(batch)


def reward_of_sldr(batch: Transitions, tmp_path: Path) -> None:
    model = load_locomotion_model(save_untrained_model(tmp_path / "model.pt", task="FetchPush"))
    stream = SldrStream("object0", SldrConfig(), model, part_view(PUSH, PUSH.parts[0]), CPU, autocast=True)
    stream.reward(batch)
    stream.object_actions(batch)


@pytest.mark.parametrize(
    "work", [update_of_the_agent, update_of_the_inverse_model, reward_and_lesson_of_rnd, reward_of_sldr]
)
def test_without_instructions_every_product_is_made_in_float32(
    work: Callable[[Transitions, Path], None], tmp_path: Path, without_instructions: None
) -> None:
    with Products() as products:
        work(batch_of(), tmp_path)

    assert set(products.dtypes) == {torch.float32}


def test_with_instructions_products_stay_in_bfloat16(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if not precision._has_instructions():
        monkeypatch.setattr(fused, "_linear_and_rectify", linear_and_rectify)
    monkeypatch.setattr(precision, "_has_instructions", lambda: True)

    with Products() as products:
        update_of_the_agent(batch_of(), tmp_path)

    # In float32 are only the last layers of the critics.
    assert products.dtypes.count(torch.bfloat16) > products.dtypes.count(torch.float32)


@pytest.mark.parametrize("bfloat16", [False, True])
def test_a_product_is_that_of_the_rounded_numbers(bfloat16: bool, without_instructions: None) -> None:
    x, weight = torch.tensor([[1.0 + 2.0**-9, 3.0]]), torch.tensor([[1.0, 1.0 + 2.0**-7]])

    with learner_precision(CPU, bfloat16):
        y = torch.nn.functional.linear(x, weight)

    # By hand: 1 + 2^-9 rounds to 1, and 1 + 3 (1 + 2^-7) = 4.0234375 rounds to 4.03125, as there they lie 2^-5 apart.
    assert y.item() == (4.03125 if bfloat16 else 4.0234375 + 2.0**-9)


def test_values_and_gradients_are_those_of_torch_s_own_bfloat16(without_instructions: None) -> None:
    generator = torch.Generator().manual_seed(0)
    actor = Mlp((28, 64, 64, 4), generator, squash=True)
    critics = MlpStack(2, (32, 64, 64, 1), generator)
    x = torch.randn(96, 28, generator=generator)

    def computed() -> list[Tensor]:
        q = critics(torch.cat([x, actor(x)], dim=-1)).float()
        return [q, *torch.autograd.grad(q.square().mean(), [*actor.parameters(), *critics.parameters()])]

    with learner_precision(CPU, bfloat16=True):
        ours = computed()
    with torch.autocast("cpu", dtype=torch.bfloat16):
        torchs = computed()
    exact = computed()

    for one, other, in_float32 in zip(ours, torchs, exact, strict=True):
        assert one.dtype is torch.float32
        apart, rounding = ((part - other).norm() / other.norm() for part in (one, in_float32))
        assert apart < 0.25 * rounding
        assert apart < SPACING


def test_values_are_not_rounded_again(without_instructions: None) -> None:
    generator = torch.Generator().manual_seed(0)
    critics, x = MlpStack(1, (8, 32, 1), generator), torch.randn(200, 8, generator=generator)
    critics.biases[-1].data.fill_(-16.0)  # from here to -32 bfloat16 numbers lie 1/8 apart

    with torch.no_grad(), learner_precision(CPU, bfloat16=True):
        rounded = critics(x)
    with torch.no_grad():
        exact = critics(x)

    assert rounded.dtype is torch.float32
    assert 0.0 < (rounded - exact).abs().max() < 0.01


def test_the_actor_learns_from_the_critics_as_they_now_are(without_instructions: None) -> None:
    agent, batch = agent_in_bfloat16(), batch_of()
    actor = deepcopy(agent.actor)

    metrics = agent.update(batch, torch.stack([batch.reward, batch.reward]))

    features, weights = agent.features(batch.obs, batch.goal), torch.tensor([1.0, 0.5])
    with torch.no_grad(), learner_precision(CPU, bfloat16=True):
        action = actor(features)
        q = agent.critics(torch.cat([features, action], dim=-1))[..., 0].float()
        loss = actor_loss(q, weights, action.float(), SMALL.action_l2)
    assert metrics["actor/loss"].item() == pytest.approx(loss.item(), rel=1e-6)


def test_a_training_in_bfloat16_repeats_and_differs_from_one_in_float32(tmp_path: Path) -> None:
    config = tiny_config("manipulation", "her")
    rounded: TrainConfig = replace(config, compute=replace(config.compute, precision="bfloat16"))

    for name, given in (("first", rounded), ("again", rounded), ("exact", config)):
        run(given, tmp_path / name)

    assert_same_training(tmp_path / "first", tmp_path / "again")
    with pytest.raises(AssertionError):
        assert_same_training(tmp_path / "first", tmp_path / "exact")
