// Draws the report that the data's "kind" names. An error is shown in place of the part that could not be drawn.

function show_error(root, error) {
  root.append(element("section", { class: "card error-box", role: "alert" },
    element("h2", { class: "bad" }, "This part of the report could not be drawn"),
    element("p", {}, String(error && error.message ? error.message : error)),
    element("p", { class: "soft" }, "The file may be damaged or incomplete. 'trammel report DIR' writes it anew.")));
  console.error(error);
}

function guarded(root, draw) {
  try {
    draw();
  } catch (error) {
    show_error(root, error);
  }
}

function main() {
  const root = document.getElementById("report");
  window.addEventListener("error", (event) => show_error(root, event.error || event.message));
  guarded(root, () => {
    const data = JSON.parse(document.getElementById("data").textContent);
    const views = { page: (d) => show_page(d.page, root) };
    if (typeof show_runs === "function") {
      views.runs = (d) => show_runs(d, root);
      views.modes = (d) => show_modes(d, root);
    }
    if (!views[data.kind]) throw new Error(`The report's data are of an unknown kind: ${data.kind}`);
    views[data.kind](data);
    document.documentElement.dataset.ready = "yes";
  });
}

main();
