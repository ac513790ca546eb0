export { default } from "../../toolpath-view/eslint.config.mjs";
