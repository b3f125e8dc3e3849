"""Claims of a paper, each judged by numbers that the runs computed: @CLAIMS(text, where, paper, why) decorates the judge.

`expected` is the verdict that the program is known to give, "yes" if nothing else; another one fails tools/reproduce. `why`
explains in words: every figure is computed by the judge, whose comments give the reason of its tolerances.
"""
import dataclasses
from typing import Callable

@dataclasses.dataclass
class Claim:
    text: str
    where: str  # in the paper
    paper: str  # what it says there
    why: str
    judge: Callable  # of the results: (the verdict, or True and False for yes and no; what was found)
    expected: str = "yes"
    verdict: str = "not judged"
    found: str = ""

    def decide(self, results):
        try:
            verdict, self.found = self.judge(results)
            self.verdict = verdict if isinstance(verdict, str) else "yes" if verdict else "no"
        except (ArithmeticError, LookupError, ValueError) as e:  # a run has ended too early for it
            self.found = f"{type(e).__name__}: {e}"

    def surprise(self):
        """A line if the verdict is not the expected one, else nothing."""
        return "" if self.verdict == self.expected else f'"{self.text}": found "{self.verdict}", expected "{self.expected}"'

class Claims(list):
    def __call__(self, text, where, paper, why, expected="yes"):
        def add(judge):
            self.append(Claim(text, where, paper, why, judge, expected))
            return judge
        return add

    def table(self):
        yield ["claim", "where", "paper", "Trammel", "holds", "why"]
        yield from ([c.text, c.where, c.paper, c.found, c.verdict, c.why] for c in self)
