// Glint's own icon: a glass ball in the evening, and the glint on it.
//
// icons/NxN.png are drawn of it by host/desktop/draw_icons; a pixel of a small icon is a large one's mean.
uniform vec3  dusk;   //@ #16324f "colour of the sky above"
uniform vec3  glow;   //@ #f28f3b "colour of the light below"
uniform float star;   //@ 0.62 [0, 1] "how far the rays of the glint reach, in half pictures"

// A star of four rays around the origin: 1 there, falling with the distance and with the way off the nearest ray.
float glint(vec2 p) {
    vec2 q = abs(p);
    float ray = max(0.0, 1.0 - (q.x + q.y) / star);
    float thin = exp(-min(q.x, q.y) * 26.0);
    return ray * ray * thin + exp(-dot(p, p) * 70.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 col = mix(glow, dusk, smoothstep(-1.3, 0.5, p.y)) * 0.55;

    // The ball, seen from the front: where it is met it mirrors the sky and refracts it upside down.
    const float kRadius = 0.78;
    float inside = kRadius * kRadius - dot(p, p);
    if (inside > 0.0) {
        vec3 nor = vec3(p, sqrt(inside)) / kRadius;
        float fresnel = 0.04 + 0.96 * pow(1.0 - nor.z, 5.0);
        vec3 refracted = mix(dusk, glow * 1.25, smoothstep(-0.75, 0.85, nor.y + 0.25 * nor.x));
        float bands = 0.5 + 0.5 * cos(16.0 * length(nor.xy - vec2(-0.30, -0.34)));
        vec3 mirrored = mix(glow, vec3(0.75, 0.88, 1.0), smoothstep(-0.2, 0.8, nor.y));
        col = mix(refracted * (0.72 + 0.28 * bands), mirrored, fresnel);
    }
    col += vec3(1.0, 0.97, 0.88) * glint(p - vec2(0.28, 0.32)) * 1.1;
    fragColor = vec4(min(col, 1.0), 1.0);
}
