// The columns of a run's series.csv, and their reduction to what a plot of some width can show.

class Series {
  constructor(data) {
    this.rows = data.rows;
    this.interval = data.interval;
    this.columns = new Map(data.columns.map((column) => [column.name, { ...column, values: f64_of(column.data) }]));
    if (!this.columns.has("t")) throw new Error("series.csv has no column t");
    this.t = this.columns.get("t").values;
  }

  values(name) {
    return this.columns.get(name)?.values;
  }

  // Columns that the scene asked for.
  observed() {
    return [...this.columns.values()].filter((c) => c.name !== "t" && c.name !== "steps" &&
      !c.name.startsWith("energy_") && !c.name.startsWith("constraint_"));
  }
}

// Index of the first t[i] >= at.
function first_from(t, at) {
  let low = 0, high = t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (t[middle] < at) low = middle + 1;
    else high = middle;
  }
  return low;
}

function value_at(t, values, at) {
  const i = first_from(t, at);
  if (i === 0) return values[0];
  if (i >= t.length) return values[t.length - 1];
  const part = (at - t[i - 1]) / (t[i] - t[i - 1] || 1);
  return values[i - 1] + part * (values[i] - values[i - 1]);
}

// Rows [t, value, ...] for a window of time: of each of `pixels` intervals the least and the largest value of every
// curve, in the order in which they come. The first and the last row are always there: the whole range stays known.
function decimated(t, curves, low, high, pixels) {
  const n = t.length;
  const begin = Math.max(0, first_from(t, low) - 1), end = Math.min(n, first_from(t, high) + 1);
  const row = (i) => [t[i], ...curves.map((values) => values[i])];
  const rows = begin > 0 ? [row(0)] : [];
  const stride = Math.max(1, Math.floor((end - begin) / pixels));
  if (stride <= 2) {
    for (let i = begin; i < end; ++i) rows.push(row(i));
  } else {
    for (let i = begin; i < end; i += stride) {
      const last = Math.min(i + stride, end) - 1;
      const first_row = [t[i]], second_row = [t[last]];
      for (const values of curves) {
        let least = i, largest = i;
        for (let k = i; k <= last; ++k) {
          if (values[k] < values[least]) least = k;
          if (values[k] > values[largest]) largest = k;
        }
        first_row.push(values[Math.min(least, largest)]);
        second_row.push(values[Math.max(least, largest)]);
      }
      rows.push(first_row);
      if (last > i) rows.push(second_row);
    }
  }
  if (end < n) rows.push(row(n - 1));
  return rows;
}
