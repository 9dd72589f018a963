// Common stands before each tab; a tab's own macros are its own.
#define SHADE(x) ((x) * (x))
#ifndef WIDTH
#define WIDTH 8.0
#endif
float stripe(float x) { return step(0.5, fract(x / WIDTH)); }
