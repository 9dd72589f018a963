// A tone in the left ear and a slow ramp in the right one.
uniform float pitch;  //@ 440 [20, 2000] log unit=Hz "of the tone"

vec2 mainSound(int samp, float time) {
    return vec2(0.5 * sin(6.2831853 * fract(pitch * time)), fract(time));
}

void mainImage(out vec4 color, in vec2 coord) {
    color = vec4(0.2, 0.3, 0.4, 1.0);
}
