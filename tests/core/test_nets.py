"""Networks and normalisers against arithmetic written out."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from sldr_core.nets.mlp import Mlp, MlpStack
from sldr_core.nets.normalizer import Normalizer

SIZES = (5, 7, 6, 3)


def seeded(seed: int = 0) -> torch.Generator:
    return torch.Generator().manual_seed(seed)


def numpy_mlp(weights: list[np.ndarray], biases: list[np.ndarray], x: np.ndarray) -> np.ndarray:
    """Return the output of ReLU layers; weights are `[outputs, inputs]`."""
    for layer, (weight, bias) in enumerate(zip(weights, biases, strict=True)):
        x = x @ weight.T + bias
        if layer < len(weights) - 1:
            x = np.maximum(x, 0.0)
    return x


def arrays(parameters: torch.nn.ParameterList) -> list[np.ndarray]:
    return [parameter.detach().numpy() for parameter in parameters]


@pytest.mark.parametrize("squash", [False, True])
@pytest.mark.parametrize("shape", [(5,), (4, 5), (2, 3, 5)])
def test_a_network_equals_the_product_written_out(squash: bool, shape: tuple[int, ...]) -> None:
    net = Mlp(SIZES, seeded(), squash=squash)
    x = torch.randn(shape, generator=seeded(1))

    output = net(x).detach().numpy()

    expected = numpy_mlp(arrays(net.weights), arrays(net.biases), x.numpy())
    np.testing.assert_allclose(output, np.tanh(expected) if squash else expected, atol=1e-6)


def test_a_stack_equals_its_networks_one_by_one() -> None:
    stack = MlpStack(3, SIZES, seeded())
    x = torch.randn((4, 5), generator=seeded(1))

    output = stack(x).detach().numpy()

    assert output.shape == (3, 4, 3)
    for index in range(3):
        weights = [weight[index].T for weight in arrays(stack.weights)]
        biases = [bias[index, 0] for bias in arrays(stack.biases)]
        np.testing.assert_allclose(output[index], numpy_mlp(weights, biases, x.numpy()), atol=1e-6)


@pytest.mark.parametrize("make", [lambda g: Mlp(SIZES, g), lambda g: MlpStack(2, SIZES, g)], ids=["mlp", "stack"])
def test_first_weights_depend_on_the_generator_alone(make) -> None:
    torch.manual_seed(1)
    first = list(make(seeded()).parameters())
    torch.manual_seed(2)
    again, other = list(make(seeded()).parameters()), list(make(seeded(5)).parameters())

    assert all(torch.equal(a, b) for a, b in zip(first, again, strict=True))
    assert not any(torch.equal(a, b) for a, b in zip(first, other, strict=True))


def test_first_weights_are_as_wide_as_those_of_a_linear_layer() -> None:
    net = Mlp((100, 400, 1), seeded())
    drawn = arrays(net.weights)[0], arrays(net.biases)[0]

    assert all(np.abs(part).max() <= 0.1 for part in drawn)
    assert abs(drawn[0].std() - 0.1 / np.sqrt(3)) < 1e-3


def test_networks_of_a_stack_start_different() -> None:
    stack = MlpStack(2, SIZES, seeded())

    assert not torch.equal(stack.weights[0][0], stack.weights[0][1])


@pytest.fixture
def data() -> np.ndarray:
    rng = np.random.default_rng(0)
    return (rng.normal(size=(500, 3)) * [0.01, 2.0, 30.0] + [5.0, -1.0, 0.0]).astype(np.float32)


def test_a_normaliser_shown_pieces_equals_mean_and_deviation_of_the_whole(data: np.ndarray) -> None:
    normalizer = Normalizer(3)

    for piece in (data[:1], data[1:8], data[8:300].reshape(4, 73, 3), data[300:]):
        normalizer.update(torch.from_numpy(piece))

    expected = np.clip((data - data.mean(axis=0)) / (data.std(axis=0) + 0.01), -5, 5)
    np.testing.assert_allclose(normalizer(torch.from_numpy(data)).numpy(), expected, atol=1e-4)


def test_values_far_out_are_clipped_before_and_after(data: np.ndarray) -> None:
    normalizer = Normalizer(1)
    normalizer.update(torch.tensor([[-300.0], [300.0]]))

    # Seen as -200 and 200: mean 0, deviation 200.
    assert normalizer(torch.tensor([[100.0]])).item() == pytest.approx(100 / 200.01)
    assert normalizer(torch.tensor([[1e6]])).item() == pytest.approx(200 / 200.01)
    narrow = Normalizer(1)
    narrow.update(torch.zeros(2, 1))
    assert narrow(torch.tensor([[1.0], [-1.0], [0.01]])).ravel().tolist() == pytest.approx([5.0, -5.0, 1.0])


def test_only_an_update_changes_a_normaliser(data: np.ndarray) -> None:
    normalizer = Normalizer(3)
    normalizer.update(torch.from_numpy(data))
    before = {name: value.clone() for name, value in normalizer.state_dict().items()}

    normalizer(torch.from_numpy(10 * data))

    assert all(torch.equal(value, before[name]) for name, value in normalizer.state_dict().items())
    normalizer.update(torch.from_numpy(10 * data))
    assert not torch.equal(normalizer.mean, before["mean"])


def test_a_normaliser_loses_no_precision_far_from_zero() -> None:
    rows = 150.0 + 1e-3 * np.random.default_rng(0).normal(size=(20_000, 1))
    normalizer = Normalizer(1)

    for piece in np.array_split(rows, 50):
        normalizer.update(torch.from_numpy(piece))

    deviation = (normalizer.m2 / normalizer.count).sqrt().item()
    assert deviation == pytest.approx(rows.std(), rel=1e-6)
