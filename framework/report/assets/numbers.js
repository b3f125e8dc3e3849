// Numbers as text, and the ticks of axes.

// With `digits` significant digits, without trailing zeros: 0.05, 1.2e-7, 12 300.
function number_text(x, digits = 5) {
  if (x === null || x === undefined || Number.isNaN(x)) return "none";
  if (!Number.isFinite(x)) return x > 0 ? "infinite" : "-infinite";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e-4 && size < 1e6) return String(Number(x.toPrecision(digits)));
  return x.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
}

function count_text(n) {
  return String(n).replace(/\B(?=(\d{3})+$)/g, ",");
}

const plural = (n, what) => `${count_text(n)} ${what}${n === 1 ? "" : "s"}`;

// Multiples of 1, 2 or 5 times a power of ten, about `wanted` of them.
function linear_ticks(low, high, wanted) {
  const rough = (high - low) / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((m) => m * power >= rough) || 10);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push({ at: k * step, text: number_text(Number((k * step).toPrecision(12)), 6) });
  return ticks;
}

const SUPERSCRIPT = "⁰¹²³⁴⁵⁶⁷⁸⁹";
function power_text(n) {
  if (n >= -2 && n <= 3) return number_text(10 ** n);
  return "10" + (n < 0 ? "⁻" : "") + [...String(Math.abs(n))].map((d) => SUPERSCRIPT[d]).join("");
}

// Powers of ten, thinned to about `wanted`; within two decades 2 and 5 as well. Without text: minor gridlines.
function logarithmic_ticks(low, high, wanted) {
  const first = Math.floor(Math.log10(low) + 1e-9), last = Math.ceil(Math.log10(high) - 1e-9);
  const stride = Math.max(1, Math.ceil((last - first) / Math.max(1, wanted)));
  const few = Math.log10(high / low) <= 2;
  const ticks = [];
  for (let n = first; n <= last; ++n)
    for (const m of stride === 1 ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : [1]) {
      const at = m * 10 ** n;
      if (at < low * (1 - 1e-9) || at > high * (1 + 1e-9)) continue;
      const named = m === 1 ? (n - first) % stride === 0 : few && (m === 2 || m === 5);
      ticks.push({ at, text: !named ? "" : m === 1 ? power_text(n) : number_text(at, 3) });
    }
  return ticks;
}

// The axis from data to pixels: `place(x)` in [from, to].
function axis(values, logarithmic, from, to, wanted) {
  let low = Infinity, high = -Infinity;
  for (const x of values) {
    if (!Number.isFinite(x) || (logarithmic && x <= 0)) continue;
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  if (low > high) [low, high] = [logarithmic ? 0.1 : 0, 1];
  if (logarithmic) {
    if (high / low < 1.5) [low, high] = [low / 2, high * 2];
    const margin = (high / low) ** 0.05;
    [low, high] = [low / margin, high * margin];
  } else {
    const round_off = 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    if (high - low <= round_off) [low, high] = [low - (Math.abs(low) / 2 || 0.5), high + (Math.abs(high) / 2 || 0.5)];
    const margin = 0.05 * (high - low);
    [low, high] = [low - margin, high + margin];
  }
  const flat = logarithmic ? Math.log10 : (x) => x;
  const scale = (to - from) / (flat(high) - flat(low));
  return {
    place: (x) => from + (flat(x) - flat(low)) * scale,
    shows: (x) => Number.isFinite(x) && (!logarithmic || x > 0),
    ticks: (logarithmic ? logarithmic_ticks : linear_ticks)(low, high, wanted),
  };
}
