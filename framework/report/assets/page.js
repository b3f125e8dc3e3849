// A page that a command handed over: its sentences, the verdict first, then figures and tables.

function show_page(page, root) {
  const [verdict, ...others] = page.sentences;
  root.append(element("h1", {}, page.title));
  if (verdict) root.append(element("p", { class: "verdict" }, verdict));
  for (const sentence of others) root.append(element("p", {}, sentence));
  const columns = element("div", { class: page.figures.length > 1 ? "columns" : null });
  root.append(columns);
  for (const figure of page.figures) columns.append(new Figure(figure).root);
  for (const table of page.tables) root.append(table_card(table));
}
