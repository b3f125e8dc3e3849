// The table of events. A click on a row, or Enter, sets the time of the animation.

const ROWS_AT_FIRST = 100;

function events_card(run, clock) {
  const { columns, rows, total, kinds } = run.events;
  if (total === 0) return null;
  const unit = (name) => ({ t: "s", impulse: "N s", approach: "m/s", separation: "m/s", energy_lost: "J" })[name] || "";
  const heads = columns.map((name) => ({ name: name.replaceAll("_", " "), unit: unit(name) }));
  const place = element("div");
  let kind = "", all = false;
  const show = () => {
    const chosen = rows.filter((row) => !kind || row[1] === kind), shown = all ? chosen : chosen.slice(0, ROWS_AT_FIRST);
    const texts = shown.map((row) => row.map((x) => (x === null ? "" : typeof x === "number" ? number_text(x, 6) : x)));
    const more = chosen.length - shown.length;
    place.replaceChildren(table_element(heads, texts, (r) => { clock.play(false); clock.set(shown[r][0]); }),
      more > 0 ? element("button", { type: "button", class: "plain", onclick: () => { all = true; show(); } },
        `Show ${plural(more, "more row")}`) : "");
  };
  show();
  const filter = element("select", { id: "kind", onchange: (event) => { kind = event.target.value; show(); } },
    element("option", { value: "" }, "all"),
    Object.entries(kinds).map(([name, n]) => element("option", { value: name }, `${name} (${count_text(n)})`)));
  const kept = rows.length < total ? ` The first ${count_text(rows.length)} are here; events.csv has all.` : "";
  return element("section", { class: "card", id: "events" }, element("h2", {}, run.label("Events")),
    element("p", { class: "soft" }, `${plural(total, "event")}. A row sets the time of the animation.${kept} `,
      element("label", {}, "Kind ", filter)), place);
}
