// Ærøskøbing, 東京, Ελλάδα, 🌊 — and “quotes” that a word processor made… \
   this line belongs to the one above, ½ of it
/* ┌──────┐ a frame
   │ café │ of letters that take several bytes */
#define TONE(x) /* naïve */ (0.2 + /* → */ (x)) // ←
void mainImage(out vec4 fragColor /* Farbe */, in vec2 fragCoord /* où? */) {
    vec2 uv = /* ⟨x, y⟩ */ fragCoord / iResolution.xy; // ÷
    fragColor = vec4(TONE(uv.x), TONE(uv.y) * 0.5, 0.4, 1.0); // — ende
}
// no line end behind this: ñ
