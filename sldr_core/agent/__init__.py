"""Who learns: DDPG with one critic per reward stream, and the inverse model of the object."""

from sldr_core.agent.ddpg import DdpgAgent
from sldr_core.agent.inverse import InverseLearner

__all__ = ["DdpgAgent", "InverseLearner"]
