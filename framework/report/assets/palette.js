// Colours that remain distinct for colour-blind readers (Okabe and Ito, 2008), each with a mark and a dash of its own, so
// that no curve is identified by its colour alone. Yellow is left out: on white it is hardly visible.

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"];
const DASHES = ["", "7 3", "2 3", "9 3 2 3", "4 2", "12 4", "1 2"];
const MARKS = ["circle", "square", "triangle", "diamond", "cross", "plus", "wedge"];

// On dark paper blue and grey are lighter.
const IN_THE_DARK = { "#0072b2": "#2f8fdc", "#7f7f7f": "#a6a6a6" };
const dark_paper = matchMedia("(prefers-color-scheme: dark)");

function colour_of(k) {
  const colour = COLOURS[k % COLOURS.length];
  return (dark_paper.matches && IN_THE_DARK[colour]) || colour;
}
const dash_of = (k) => DASHES[Math.floor(k / COLOURS.length) % DASHES.length];
const mark_of = (k) => MARKS[k % MARKS.length];

// The outline of a mark around (x, y), and whether it is filled.
function mark_path(mark, x, y, r = 4.5) {
  const at = (points) => "M" + points.map(([a, b]) => `${(x + a * r).toFixed(1)},${(y + b * r).toFixed(1)}`).join("L");
  switch (mark) {
    case "circle":
      return `M${(x - r * 0.9).toFixed(1)},${y.toFixed(1)}a${r * 0.9},${r * 0.9} 0 1,0 ${r * 1.8},0a${r * 0.9},${r * 0.9} 0 1,0 ${-r * 1.8},0Z`;
    case "square":
      return at([[-0.8, -0.8], [0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]]) + "Z";
    case "triangle":
      return at([[0, -1.1], [1, 0.8], [-1, 0.8]]) + "Z";
    case "wedge":
      return at([[0, 1.1], [1, -0.8], [-1, -0.8]]) + "Z";
    case "diamond":
      return at([[0, -1.15], [1.15, 0], [0, 1.15], [-1.15, 0]]) + "Z";
    case "cross":
      return at([[-0.9, -0.9], [0.9, 0.9]]) + at([[-0.9, 0.9], [0.9, -0.9]]);
    default:
      return at([[-1.1, 0], [1.1, 0]]) + at([[0, -1.1], [0, 1.1]]);
  }
}

function mark_element(k, x, y, r) {
  const mark = mark_of(k), colour = colour_of(k), open = mark === "cross" || mark === "plus";
  return drawn("path", { d: mark_path(mark, x, y, r), fill: open ? "none" : colour, stroke: open ? colour : "none",
                         "stroke-width": 2 });
}
