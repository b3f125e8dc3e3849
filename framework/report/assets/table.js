// A table: texts to the left, numbers to the right.

const is_number = (text) => text === "" || /^[-+]?[\d.,]+(e[-+]?\d+)?\s*%?$/i.test(String(text).trim());

// columns: [{name, unit}]; rows: texts. `on_row(k)` is called when row k is clicked or Enter is pressed on it.
function table_element(columns, rows, on_row) {
  const numeric = columns.map((_, c) => rows.length > 0 && rows.every((row) => is_number(row[c] ?? "")));
  const kind = (c) => (numeric[c] ? "number" : null);
  const head = element("tr", {}, columns.map((column, c) => element("th", { class: kind(c), scope: "col" }, column.name,
    column.unit ? element("span", { class: "unit" }, ` [${column.unit}]`) : null)));
  const body = rows.map((row, r) => {
    const cells = columns.map((_, c) => element("td", { class: kind(c) }, row[c] ?? ""));
    if (!on_row) return element("tr", {}, cells);
    return element("tr", { tabindex: "0", class: "chosen-by-click", onclick: () => on_row(r),
      onkeydown: (event) => event.key === "Enter" && on_row(r) }, cells);
  });
  return element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "table" },
    element("table", {}, element("thead", {}, head), element("tbody", {}, body)));
}

// A card with a table of {title, columns, rows}.
function table_card(table) {
  return element("section", { class: "card" }, element("h2", {}, table.title), table_element(table.columns, table.rows));
}
