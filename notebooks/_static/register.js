// Filters for the cards of the register: by section, verdict and words. Without this script all cards are shown.
document.addEventListener("DOMContentLoaded", () => {
  const cards = [...document.querySelectorAll("div.claim")];
  if (!cards.length) return;
  const make = (tag, options, ...children) => {
    const element = Object.assign(document.createElement(tag), options);
    element.append(...children);
    return element;
  };
  const choice = (id, label, values, all) => {
    const select = make("select", { id }, make("option", { value: "" }, all), ...values.map((v) => make("option", { value: v }, v)));
    return [select, make("label", { htmlFor: id }, label)];
  };
  const different = (key) => [...new Set(cards.map((card) => card.dataset[key]))];
  const [section, sectionLabel] = choice("claim-section", "section", different("section"), "all sections");
  const [verdict, verdictLabel] = choice("claim-verdict", "verdict", different("verdict"), "all verdicts");
  const words = make("input", { id: "claim-words", type: "search", placeholder: "such as Gabriel" });
  const wordsLabel = make("label", { htmlFor: "claim-words" }, "words");
  const count = make("output", {});
  count.setAttribute("for", "claim-section claim-verdict claim-words");
  const pair = (...parts) => make("span", {}, ...parts);
  const bar = make("div", { className: "claim-filter" }, pair(sectionLabel, section), pair(verdictLabel, verdict), pair(wordsLabel, words), count);
  bar.setAttribute("role", "search");
  bar.setAttribute("aria-label", "Filter the register");

  const parts = [...new Set(cards.map((card) => card.closest("section")))];
  parts[0].parentElement.insertBefore(bar, parts[0]);
  const show = () => {
    const wanted = words.value.toLowerCase().split(/\s+/);
    for (const card of cards) {
      const text = card.textContent.toLowerCase();
      card.hidden = Boolean(section.value && card.dataset.section !== section.value)
        || Boolean(verdict.value && card.dataset.verdict !== verdict.value) || !wanted.every((word) => text.includes(word));
    }
    for (const part of parts) part.hidden = cards.every((card) => card.hidden || card.closest("section") !== part);
    const shown = cards.filter((card) => !card.hidden).length;
    count.textContent = `${shown} of ${cards.length}${shown ? "" : ": nothing fits all three"}`;
  };
  // A link to a card shows it, whatever is filtered.
  const reveal = () => {
    const card = location.hash.startsWith("#row-") && document.getElementById(location.hash.slice(1));
    if (!card || !card.hidden) return;
    section.value = verdict.value = words.value = "";
    show();
    card.scrollIntoView();
  };
  for (const control of [section, verdict, words]) control.addEventListener("input", show);
  addEventListener("hashchange", reveal);
  // A second click on the same link changes no hash.
  for (const link of document.querySelectorAll('a[href^="#row-"]')) link.addEventListener("click", () => setTimeout(reveal));
  show();
  reveal();
});
