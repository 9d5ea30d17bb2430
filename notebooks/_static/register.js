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
  const bar = make("div", { className: "claim-filter" }, sectionLabel, section, verdictLabel, verdict, wordsLabel, words, count);
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
    count.textContent = `${cards.filter((card) => !card.hidden).length} of ${cards.length}`;
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
  show();
  reveal();
});
