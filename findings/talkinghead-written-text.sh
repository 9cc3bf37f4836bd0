#!/bin/sh
# TalkingHead's lip sync speaks "$5" as "dollars five", gives "don’t" with a typographic apostrophe a vowel more than "don't", and in
# German reads 7:30 as seven hundred and thirty and no minus.
# Guess before the run: in English "-3" is "minus three" (right) and "don't" is no trouble. Of "$5", the other apostrophe, U+2212
# and German there was no guess; what is expected of them was put down after the run.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts @met4citizen/talkinghead@1.7.0
cat >check.mjs <<'JS'
import { LipsyncDe } from "./node_modules/@met4citizen/talkinghead/modules/lipsync-de.mjs";
import { LipsyncEn } from "./node_modules/@met4citizen/talkinghead/modules/lipsync-en.mjs";

const modules = { en: new LipsyncEn(), de: new LipsyncDe() };
function spoken(language, text) {
  const words = modules[language].preProcessText(text);
  return `${words} [${modules[language].wordsToVisemes(words).visemes.join(" ")}]`;
}
const expected = [
  ["en", "$5", "dollars five [DD aa nn aa RR SS FF aa FF]"],
  ["en", "don't", "don't [DD O nn DD]"],
  ["en", "don’t", "don’t [DD aa nn DD]"],
  ["en", "-3", "minus three [PP I nn aa SS TH RR I]"],
  ["en", "\u22123", "\u2212three [TH RR I]"],
  ["de", "-3", "-drei [DD RR aa I]"],
  ["de", "7:30", "siebenhundertdreißig [SS I PP E nn U nn DD E RR DD RR aa I SS I kk]"],
];
const seen = expected.map(([language, text]) => spoken(language, text));
console.log("version: @met4citizen/talkinghead 1.7.0");
console.log("behaviour:", expected.map(([language, text], i) => `${language} ${text} is ${seen[i]}`).join("; "));
console.log('expected: "five dollars"; "don’t" as "don\'t"; U+2212 as "-"; "minus drei"; "sieben Uhr dreißig"');
if (expected.some(([, , words], i) => words !== seen[i])) {
  console.error("the behaviour has changed");
  process.exit(1);
}
JS
node check.mjs
