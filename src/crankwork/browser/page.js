// The page of a machine without sliders.
import { Figure } from "./figure.js";
import { openStored } from "./opened.js";

openStored(Figure);
