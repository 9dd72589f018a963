// What is never written is 0: browsers see to it, whatever the site hands to mainImage.
void mainImage(out vec4 fragColor, in vec2 fragCoord) { if (fragCoord.x > 64.0) fragColor = vec4(0.2, 0.4, 0.6, 1.0); }
