// A march over a field of spheres that always takes all its steps: the cost is the constant below.
const int kSteps = 32;

// Signed distance to spheres of radius 0.3 at the points of an integer lattice.
float map(vec3 p) {
    return length(p - floor(p + 0.5)) - 0.3;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 rd = normalize(vec3(uv, 1.5));
    vec3 pos = vec3(0.5, 0.5, iTime);
    float travelled = 0.0;
    for (int i = 0; i < kSteps; ++i) travelled += 0.5 * map(pos + travelled * rd);
    pos += travelled * rd;
    vec3 nor = normalize(pos - floor(pos + 0.5));
    fragColor = vec4((0.5 + 0.5 * nor) * exp(-0.1 * travelled), 1.0);
}
