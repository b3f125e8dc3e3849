"""Claims of a paper: each is judged by numbers that the runs computed."""
import dataclasses
from typing import Callable

from runs import Run


@dataclasses.dataclass
class Verdict:
    """What Trammel computed, in words and numbers; holds: "yes", "no" or "partly"."""

    trammel: str
    holds: str


@dataclasses.dataclass
class Claim:
    claim: str
    paper: str
    why: str
    runs: list[Run]
    judge: Callable  # of the results

    def row(self, results):
        verdict = self.judge(results)
        return [self.claim, self.paper, verdict.trammel, verdict.holds, self.why]


def yes_if(condition, trammel):
    return Verdict(trammel, "yes" if condition else "no")


def markdown(header, rows):
    lines = ["| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in [header, ["---"] * len(header), *rows]]
    return "\n".join(lines)
