// A scene to begin with: ink that is drawn, drifts, and fades. A pass reads the picture that it made
// before, and goes on from there.
//
// Draw with the mouse; without it a pen moves by itself. Save this file while the window is open: the
// picture follows at once, and both the sliders and the ink stay.

// A uniform whose comment begins with //@ is a slider. Its default stands first, its range in brackets,
// what it does in quotes; `unit` is shown behind the number. `log` gives small values as much of the
// slider as large ones.
uniform float fade;  //@ 4 [0.2, 20] log unit=s "how long ink stays"
uniform float swirl; //@ 0.25 [-2, 2] unit=1/s "how fast it turns about the middle"
uniform float width; //@ 0.045 [0.005, 0.2] log "of the pen; 1 is the height of the picture"
// A vec3 with a # is a colour.
uniform vec3  paper; //@ #11151c "colour without ink"

// `pass mainInk` makes the sampler a buffer that the function mainInk() fills; it is as large as the
// picture. `step=1/60` is the time from one to the next in seconds, so that the ink runs the same at any
// frame rate; without it the function is called once a frame. Beyond the edge it reads the edge.
uniform sampler2D ink; //@ pass mainInk step=1/60

const float kTurn = 6.2831853;  // radians

// From 0 to 1, so many times a second. iTick counts time in 1/65536 s: whole numbers are as exact after
// a year as in the first second, where sin(iTime) has lost its digits.
float turns(float hz) {
    return float(uint(int(hz * 65536.0)) * iTick) / 4294967296.0;
}

// A colour of the rainbow, for any number.
vec3 rainbow(float x) {
    return 0.5 + 0.5 * cos(kTurn * (x + vec3(0.0, 0.33, 0.67)));
}

void mainInk(out vec4 result, in vec2 pixel) {
    // Where the ink that is here now was one step ago. iTimeDelta is the length of the step, in seconds.
    vec2 p = pixel - 0.5 * iResolution.xy;
    float angle = swirl * iTimeDelta;
    vec2 from = mat2(cos(angle), -sin(angle), sin(angle), cos(angle)) * p * (1.0 - 0.1 * iTimeDelta);
    vec3 before = texture(ink, (from + 0.5 * iResolution.xy) / iResolution.xy).rgb;

    float phase = kTurn * turns(0.1);
    vec2 pen = iResolution.xy * (0.5 + 0.35 * vec2(sin(3.0 * phase), cos(2.0 * phase)));
    if (iMouse.z > 0.0) pen = iMouse.xy;
    vec2 away = (pixel - pen) / (width * iResolution.y);
    float drop = exp(-dot(away, away));

    before *= exp(-iTimeDelta / fade);
    result = vec4(clamp(mix(before, rainbow(turns(0.3)), drop), 0.0, 1.0), 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 color = texelFetch(ink, ivec2(fragCoord), 0).rgb;
    fragColor = vec4(paper * (1.0 - color) + color, 1.0);
}
