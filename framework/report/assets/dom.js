// Elements of the page, built from data and never from markup: text of a scene cannot become HTML.

const SVG = "http://www.w3.org/2000/svg";

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of [children].flat(Infinity))
    if (child !== undefined && child !== null) element.append(child);
  return element;
}

const element = (tag, attributes, ...children) => filled(document.createElement(tag), attributes, children);
const drawn = (tag, attributes, ...children) => filled(document.createElementNS(SVG, tag), attributes, children);

// Calls `draw(width)` now and whenever the element becomes wider or narrower.
function at_its_width(of, draw) {
  let width = 0;
  const look = () => {
    const now = Math.round(of.clientWidth);
    if (now > 0 && now !== width) draw((width = now));
  };
  // Draws in the next frame, because drawing changes sizes, which must not happen while the observer reports.
  new ResizeObserver(() => requestAnimationFrame(look)).observe(of);
}
