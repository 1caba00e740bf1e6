"""Fused layers give the values and gradients that torch gives one operation after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
import torch
from plain_layers import linear_and_rectify, through_layers
from torch import Tensor

from sldr_core.nets import fused, precision
from sldr_core.nets.fused import PIECE_ROWS, read_out, rectified
from sldr_core.nets.mlp import Mlp, MlpStack
from sldr_core.nets.precision import learner_precision

CPU = torch.device("cpu")
SIZES = (12, 32, 64, 16)
ROWS = 2 * PIECE_ROWS + 100
SPACING = 2.0**-8
"""How far bfloat16 numbers lie apart at most, in parts of themselves."""

Layers = list[tuple[Tensor, Tensor]]
"""Weight and bias of each."""

HAS_INSTRUCTIONS = precision._has_instructions()


@pytest.fixture(
    params=[
        pytest.param(
            fused._linear_and_rectify,
            id="oneDNN's",
            marks=pytest.mark.skipif(not HAS_INSTRUCTIONS, reason="this processor has no instructions for bfloat16"),
        ),
        pytest.param(linear_and_rectify, id="torch's"),
    ],
    autouse=True,
)
def product(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the product in either way: the way back is the same, and can be tried on any processor."""
    monkeypatch.setattr(fused, "_linear_and_rectify", request.param)


@pytest.fixture
def with_instructions(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(precision, "_has_instructions", lambda: True)
    with learner_precision(CPU, bfloat16=True):
        yield


def layers_of(sizes: tuple[int, ...], generator: torch.Generator) -> Layers:
    net = Mlp((*sizes, 1), generator)
    return list(zip(net.weights, net.biases, strict=True))[:-1]


def values_and_gradients(compute: Callable[..., Tensor], x: Tensor, layers: Layers) -> list[Tensor]:
    value = compute(x, layers)
    towards = torch.randn(value.shape, generator=torch.Generator().manual_seed(7)).bfloat16()
    learnt = [parameter for layer in layers for parameter in layer if parameter.requires_grad]
    return [value, *torch.autograd.grad(value, [x] * x.requires_grad + learnt, towards)]


def assert_alike(ours: list[Tensor], theirs: list[Tensor]) -> None:
    assert len(ours) == len(theirs)
    for one, other in zip(ours, theirs, strict=True):
        assert one.dtype is other.dtype
        assert one.shape == other.shape
        assert (one - other).float().norm() < SPACING * other.float().norm()


@pytest.mark.parametrize("layers", [1, 2, 3])
@pytest.mark.parametrize("shape", [(50,), (5, 7)], ids=["batch", "episodes"])
def test_hidden_layers_are_those_of_torch(layers: int, shape: tuple[int, ...]) -> None:
    generator = torch.Generator().manual_seed(0)
    made = layers_of(SIZES[: layers + 1], generator)
    x = torch.randn((*shape, SIZES[0]), generator=generator, requires_grad=True)

    assert_alike(values_and_gradients(rectified, x, made), values_and_gradients(through_layers, x, made))


def test_what_does_not_learn_is_spared_its_gradient() -> None:
    generator = torch.Generator().manual_seed(0)
    made = layers_of(SIZES, generator)
    x = torch.randn((50, SIZES[0]), generator=generator)
    held = [(weight.detach(), bias.detach()) for weight, bias in made]

    assert_alike(values_and_gradients(rectified, x, made), values_and_gradients(through_layers, x, made))
    x.requires_grad_()
    assert_alike(values_and_gradients(rectified, x, held), values_and_gradients(through_layers, x, held))


def test_a_gradient_that_is_handed_in_stays_as_it_is() -> None:
    generator = torch.Generator().manual_seed(0)
    made = layers_of(SIZES, generator)
    towards = torch.ones(50, SIZES[-1]).bfloat16()

    torch.autograd.grad(rectified(torch.randn((50, SIZES[0]), generator=generator), made), made[0], towards)

    assert (towards == 1.0).all()


def test_the_last_layer_is_not_rounded_in_any_piece() -> None:
    generator = torch.Generator().manual_seed(0)
    hidden = torch.randn((ROWS, 16), generator=generator).bfloat16().requires_grad_()
    weight, bias = torch.randn((1, 16), generator=generator, requires_grad=True), torch.zeros(1, requires_grad=True)
    error = torch.randn((ROWS, 1), generator=generator)

    # Within autocast, as in an update: what is not asked for in float32 would be rounded.
    with learner_precision(CPU, bfloat16=True):
        value = read_out(hidden, weight, bias)
        of_hidden, of_weight, of_bias = torch.autograd.grad(value, [hidden, weight, bias], error)

    exactly, errors = hidden.detach().double(), error.double()
    torch.testing.assert_close(value.double(), exactly @ weight.detach().double().t(), rtol=1e-5, atol=1e-5)
    torch.testing.assert_close(of_weight.double(), errors.t() @ exactly, rtol=1e-4, atol=1e-3)
    torch.testing.assert_close(of_bias.double(), errors.sum(dim=0), rtol=1e-4, atol=1e-4)
    assert_alike([of_hidden], [(error * weight.detach()).bfloat16()])


def test_networks_are_fused_while_they_are_computed_in_bfloat16(
    with_instructions: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    generator = torch.Generator().manual_seed(0)
    actor, critics = Mlp((28, 64, 64, 4), generator, squash=True), MlpStack(2, (32, 64, 64, 1), generator)
    x = torch.randn(96, 28, generator=generator)

    ours = _of_networks(actor, critics, x)
    monkeypatch.setattr(precision, "_has_instructions", lambda: False)
    theirs = _of_networks(actor, critics, x)

    assert_alike(ours, theirs)
    assert any((one != other).any() for one, other in zip(ours, theirs, strict=True))


def _of_networks(actor: Mlp, critics: MlpStack, x: Tensor) -> list[Tensor]:
    """Return values and gradients of critics that judge what an actor does."""
    q = critics(torch.cat([x, actor(x)], dim=-1))
    return [q, *torch.autograd.grad(q.square().mean(), [*actor.parameters(), *critics.parameters()])]
