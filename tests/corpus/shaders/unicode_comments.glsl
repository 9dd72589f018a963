// éà ☃ 🎄 in a comment, and a tab	and a form feed
void mainImage(out vec4 c, in vec2 p) { /* α */ c = vec4(0.3, p.y / iResolution.y, 0.6, 1.0); }
