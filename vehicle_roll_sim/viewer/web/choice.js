/** Which of many runs are shown; a change reloads the page with another address. */

/** Places of the runs to show: those of the address, #runs=1,3 counted from 1, else the first. */
function chosenRuns({ runs, shown, most }) {
  const said = new URLSearchParams(location.hash.slice(1)).get("runs") || "";
  const places = said.split(",").map((each) => Number(each) - 1);
  const known = [...new Set(places)].filter((each) => Number.isInteger(each) && each in runs);
  return known.length ? known.slice(0, most) : shown;
}

/** Open the page anew with these runs, in its present colours. */
function openRuns(places) {
  const address = new URLSearchParams(location.hash.slice(1));
  address.set("runs", places.map((each) => each + 1).join(","));
  address.set("theme", document.documentElement.dataset.theme);
  location.hash = address;
  location.reload();
}

/** The map of a study, if the page is of one. */
function offerMap(parent, { study, most }, chosen) {
  parent.hidden = !study;
  if (parent.hidden) return;
  new StudyMap(parent, study, chosen, (place, isBeside) => {
    const others = isBeside ? chosen.filter((each) => each !== place).slice(0, most - 1) : [];
    openRuns([...others, place]);
  });
}

/** The worst event of a run, in a word. */
function outcome(run) {
  if (run.rollover !== null) return "rollover";
  return run.events.some((each) => each.isSevere) ? "lift-off" : "";
}

/** A box to tick for each run, if there are more than can be shown at once. */
function offerRuns(parent, { runs, most }, chosen) {
  parent.hidden = runs.length <= most;
  if (parent.hidden) return;
  parent.querySelector("summary").textContent = `Runs: ${chosen.length} of ${runs.length} shown`;
  runs.forEach((run, place) => {
    const box = element("input", "", { type: "checkbox", checked: chosen.includes(place) });
    box.disabled = box.checked ? chosen.length === 1 : chosen.length === most;
    box.addEventListener("change", () => {
      const now = box.checked ? [...chosen, place] : chosen.filter((each) => each !== place);
      openRuns(now);
    });
    const label = element("label"), item = element("li"), what = outcome(run);
    label.append(box, ` ${run.label}${what ? ` (${what})` : ""}`);
    item.append(label);
    parent.querySelector("ul").append(item);
  });
}
