"""Claims of a paper: each is judged by numbers that the runs computed."""
import dataclasses
from typing import Callable

from studies import Case


@dataclasses.dataclass
class Verdict:
    """What Trammel computed, in words and numbers; holds: "yes", "no", "partly" or under what condition."""

    trammel: str
    holds: str


@dataclasses.dataclass
class Claim:
    """`why` explains in words: every figure of a claim is computed by its judge. `expected`: the verdict that the program is
    known to give; another one fails tools/reproduce."""

    claim: str
    paper: str
    why: str
    cases: list[Case]
    judge: Callable  # of the results
    expected: str = "yes"

    def row(self, verdict):
        return [self.claim, self.paper, verdict.trammel, verdict.holds, self.why]

    def surprise(self, verdict):
        """A line if the verdict is not the expected one, else nothing."""
        return "" if verdict.holds == self.expected else f'"{self.claim}": found "{verdict.holds}", expected "{self.expected}"'


def yes_if(condition, trammel):
    return Verdict(trammel, "yes" if condition else "no")


def markdown(header, rows):
    lines = ["| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in [header, ["---"] * len(header), *rows]]
    return "\n".join(lines)
