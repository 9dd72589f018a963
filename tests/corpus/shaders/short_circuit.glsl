// && and || leave out what no longer matters; ^^ and ?: do as they should.
int calls = 0;
bool ask(bool answer) { ++calls; return answer; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) / 9;
    bool a = ask((p.x & 1) == 0) && ask((p.y & 1) == 0);
    bool b = ask((p.x & 2) == 0) || ask((p.y & 2) == 0);
    bool c = p.x > 6 ? ask(a) : !ask(b) && ask(true);
    fragColor = vec4(float(calls) / 6.0, float(a ^^ b), float(c) * 0.5 + 0.25, 1.0);
}
