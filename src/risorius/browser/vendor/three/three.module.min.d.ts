// Types for the checks of this code: those of the npm package @types/three.
export * from "three";
