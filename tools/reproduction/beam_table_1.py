"""Table 1 of the beam's paper: computing times of 2 s, e = 0. Standard library only: tools/bench uses it too."""

MODES = [3, 5, 7, 9]
SECONDS_OF_PAPER = {
    "HHT alpha = 0": [305, 799, 2914, 9818],
    "HHT alpha = -0.15": [244, 589, 2573, 8725],
    "HHT alpha = -1/3": [166, 401, 2092, 7233],
    "Baumgarte (0, 0)": [67, 339, 1285, 2341],
    "Baumgarte (10, 50)": [64, 325, 1217, 2231],
    "Baumgarte (1000, 5000)": [63, 319, 1198, 2192],
}
ALPHAS = [("0", 0), ("-0.15", -0.15), ("-1/3", "=-1/3")]
PAIRS = [(0, 0), (10, 50), (1000, 5000)]
