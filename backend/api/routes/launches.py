"""Asking for training: what a launch would queue, and queueing it."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import Launch, LaunchPlan, LaunchResult

router = APIRouter(prefix="/api/launches", tags=["launches"])


@router.post("/plan", responses=problem_responses(422))
def plan_launch(launch: Launch) -> LaunchPlan:
    """Tell what a launch would queue and which existing runs it would share; queue nothing."""
    raise NotBuilt


@router.post("", status_code=201, responses=problem_responses(422))
def create_launch(launch: Launch) -> LaunchResult:
    """Queue a launch's runs, the locomotion run they need first."""
    raise NotBuilt
