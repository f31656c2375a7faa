"""Campaigns: very many random cases, made from a seed, that can be stopped, continued and repeated one by one.

A *case* is made from the seed and its number alone, so that one that went wrong can be repeated without the others.
The same code runs as a test for some seconds and as a campaign for hours.

========== ==========================================================================================================
`planning` random states of the planner, in families: a refused plan or one that breaks an independent rule fails
`life`     random machines whose programs command, override, fail and get cancelled; judged by `motionlayer.verify` and
           by the rules of a command's life
`blocks`   random calls of function blocks on axes whose drives fail; every call is observed, the trace is judged
`contract` random clients of the motion layer write commands and data; judged by an oracle that knows nothing but the
           text of its interface, and by `motionlayer.verify`
`ads`      damaged requests of an ADS client; nothing stops, nothing is left behind, another client is not disturbed
`siege`    bad clients of a real ADS server process: half-open connections, huge lengths, nobody who reads; it answers
           another client in time, says nothing, and does not grow
`mutation` a sample, plan or event of a valid trace is changed, or what was asked for; `motionlayer.verify` must find it
========== ==========================================================================================================
"""

from typing import Final

from motionlayer.bench.campaign._ads import ADS
from motionlayer.bench.campaign._ads_siege import SIEGE
from motionlayer.bench.campaign._blocks import BLOCKS
from motionlayer.bench.campaign._campaign import Campaign, Failure
from motionlayer.bench.campaign._contract import CONTRACT
from motionlayer.bench.campaign._life import LIFE
from motionlayer.bench.campaign._mutation import MUTATION
from motionlayer.bench.campaign._planning import PLANNING
from motionlayer.bench.campaign._pursuit import State, StateError, pursue, repeat, resume

CAMPAIGNS: Final = {campaign.name: campaign for campaign in (PLANNING, LIFE, BLOCKS, CONTRACT, MUTATION, ADS, SIEGE)}

__all__ = ["CAMPAIGNS", "Campaign", "Failure", "State", "StateError", "pursue", "repeat", "resume"]
