"""The training loop: cycles make epochs, each epoch ends with a test, and any moment can be resumed."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import torch

from sldr_core.config import TrainConfig
from sldr_core.episodes import kept_epochs, tag_shares
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets.budget import CHECKPOINT_CYCLES
from sldr_core.records import Step
from sldr_core.training.build import Parts, build_training
from sldr_core.training.checkpoint import (
    Counters,
    keep_previous,
    read_newest,
    restore_training,
    write_checkpoint,
)
from sldr_core.training.cycle import CYCLES, collect_random
from sldr_core.training.directory import alone_in
from sldr_core.training.dump import keep_evidence
from sldr_core.training.files import (
    BEST_POLICY_FILE,
    CHECKPOINT_FILE,
    LOCOMOTION_FILE,
    NEWEST_POLICY_FILE,
    keeps_policy,
    kept_policy_file,
)
from sldr_core.training.finite import NonFinite, check_metrics, check_weights
from sldr_core.training.policy import write_policy
from sldr_core.training.recorder import Recorder, StopReason
from sldr_core.training.recording import EpisodeRecording
from sldr_core.training.rollout import Collected, numpy_policy
from sldr_core.training.testing import run_test
from sldr_core.training.witness import Witness


@dataclass(frozen=True)
class TrainResult:
    """How a training ended."""

    finished: bool
    stopped: StopReason | None
    test_success_rate: float | None
    best_success_rate: float | None


class _Cancelled(Exception):
    """Leave the loop at once; what this cycle did is not kept."""


def train(
    config: TrainConfig, recorder: Recorder, locomotion_models: Sequence[Path] = (), gate_waived: bool = False
) -> TrainResult:
    """Train to the end, or until the recorder asks to stop; go on from the directory's checkpoint if there is one.

    Args:
        config: what to train.
        recorder: where numbers and files go, and who may ask to stop.
        locomotion_models: one file for each task of `locomotion_tasks(config)`, in any order.
        gate_waived: whether models below the gate are taken as well.

    Raises:
        SldrError: something that would fail again: a bad file, a missing model, a full disk, diverged numbers.
    """
    with alone_in(recorder.directory):
        # Read before anything is built: building would replace the replay file of another config.
        kept = read_newest(recorder.directory, config)
        counters = kept.counters if kept else Counters()
        stopped: StopReason | None = None
        if not counters.are_final(config):
            parts = build_training(config, recorder.directory, locomotion_models, gate_waived)
            if kept:
                restore_training(kept, parts)
            try:
                stopped = _Loop(parts, counters, recorder).run()
            except _Cancelled:
                stopped = "cancel"
    return TrainResult(
        finished=stopped is None,
        stopped=stopped,
        test_success_rate=_if_tested(counters.test_success_rate),
        best_success_rate=_if_tested(counters.best_success_rate),
    )


class _Loop:
    """Drive one training from its counters onwards."""

    def __init__(self, parts: Parts, counters: Counters, recorder: Recorder) -> None:
        self._parts = parts
        self._loop = parts.config.loop
        self._counters = counters
        self._recorder = recorder
        self._recording = EpisodeRecording(parts)
        self._clock = time.monotonic() - counters.wall_seconds
        self._cycle = 0

    def run(self) -> StopReason | None:
        """Run cycles until the end, or a request to stop; return that request.

        Raises:
            TrainingDiverged: a number is not finite; what it came from is kept in a file.
        """
        try:
            return self._run()
        except NonFinite as err:
            raise keep_evidence(err, self._cycle, self._parts.config, self._recorder) from err

    def _run(self) -> StopReason | None:
        while self._counters.cycle == 0 and self._counters.warmup_cycles < self._loop.warmup_cycles:
            self._warm_up()
            stop = self._recorder.stop_requested()
            if stop is not None:
                self._save_checkpoint()
                return stop
        while not self._is_finished():
            self._run_cycle()
            stop = self._recorder.stop_requested()
            if stop is not None or self._counters.cycle % CHECKPOINT_CYCLES == 0 or self._is_finished():
                self._save_checkpoint()
            if stop is not None and not self._is_finished():
                return stop
        return None

    def _warm_up(self) -> None:
        collected, _ = collect_random(self._parts, self._check)
        self._count(collected)
        self._counters.warmup_cycles += 1

    def _run_cycle(self) -> None:
        counters = self._counters
        self._cycle = counters.cycle + 1
        check_weights(self._parts.learner_states())
        done = CYCLES[self._loop.collecting](self._parts, counters.updates, self._check)
        metrics = done.metrics
        self._count(done.collected)
        counters.updates += self._loop.updates_per_cycle
        counters.cycle += 1
        metrics["train/success_rate"] = float(done.collected.success.mean())
        if counters.cycle % self._loop.cycles_per_epoch == 0:
            metrics.update(self._test())
        counters.wall_seconds = time.monotonic() - self._clock
        metrics.update(self._progress())
        check_metrics(metrics)
        self._recorder.log(self._step(), metrics)

    def _test(self) -> dict[str, float]:
        counters = self._counters
        act = numpy_policy(self._parts.agent.act_averaged)
        witness = Witness(self._parts.test_envs, self._loop.recorded_episodes)
        result = run_test(self._parts.test_envs, act, self._loop.test_episodes, self._check, witness)
        rate = result.success_rate
        counters.test_success_rate = rate
        counters.tests_held = counters.tests_held + 1 if rate >= self._loop.stop_at_success else 0
        write = partial(write_policy, parts=self._parts, counters=counters)
        self._recorder.save_file(NEWEST_POLICY_FILE, "policy", write)
        epoch = self._step().epoch
        if keeps_policy(epoch, self._loop.epochs):
            self._recorder.save_file(kept_policy_file(epoch), "policy", write)
        if rate >= counters.best_success_rate:
            counters.best_success_rate = rate
            counters.best_epoch = epoch
            self._recorder.save_file(BEST_POLICY_FILE, "policy", write)
            if self._parts.inverse is not None:
                model = _locomotion_model(self._parts, Measured(rate, result.episodes))
                self._recorder.save_file(LOCOMOTION_FILE, "locomotion", model.save)
        self._record_episodes(witness)
        return {
            "test/success_rate": rate,
            "test/best_success_rate": counters.best_success_rate,
            "test/final_distance": result.mean_final_distance,
            **{f"episodes/{tag}_share": share for tag, share in tag_shares(witness.tags).items()},
        }

    def _record_episodes(self, witness: Witness) -> None:
        if witness.courses:
            step = self._step()
            test = self._recording.record(witness.courses, step.epoch, step.env_steps)
            self._recorder.record_episodes(test, kept_epochs(step.epoch, self._counters.best_epoch))

    def _is_finished(self) -> bool:
        return self._counters.are_final(self._parts.config)

    def _progress(self) -> dict[str, float]:
        warmup = self._loop.warmup_cycles
        share = (warmup + self._counters.cycle) / (warmup + self._parts.config.total_cycles)
        done = 1.0 if self._is_finished() else share
        return {
            "progress/fraction": done,
            "progress/seconds_left": self._counters.wall_seconds * (1.0 - done) / done,
        }

    def _count(self, collected: Collected) -> None:
        count, length = collected.episodes.action.shape[:2]
        self._counters.env_steps += count * length
        self._counters.episodes += count

    def _step(self) -> Step:
        counters = self._counters
        return Step(
            cycle=counters.cycle,
            epoch=-(-counters.cycle // self._loop.cycles_per_epoch),
            env_steps=counters.env_steps,
            episodes=counters.episodes,
            updates=counters.updates,
            wall_seconds=counters.wall_seconds,
        )

    def _save_checkpoint(self) -> None:
        def write(path: Path) -> None:
            write_checkpoint(path, self._parts, self._counters)
            keep_previous(self._recorder.directory)

        self._recorder.save_file(CHECKPOINT_FILE, "checkpoint", write)

    def _check(self) -> None:
        if self._recorder.stop_requested() == "cancel":
            raise _Cancelled


def _locomotion_model(parts: Parts, measured: Measured) -> LocomotionModel:
    """Take the object's networks out of a locomotion training."""
    assert parts.inverse is not None
    nets = LocomotionNets(parts.config, torch.Generator())
    nets.normalizer.load_state_dict(parts.agent.normalizer.state_dict())
    nets.policy.load_state_dict(parts.agent.averaged_actor.state_dict())
    nets.critic.load_state_dict(parts.agent.critics.state_dict())
    nets.transition_normalizer.load_state_dict(parts.inverse.normalizer.state_dict())
    nets.inverse.load_state_dict(parts.inverse.net.state_dict())
    return LocomotionModel(nets, parts.config, measured)


def _if_tested(rate: float) -> float | None:
    return rate if rate >= 0.0 else None
