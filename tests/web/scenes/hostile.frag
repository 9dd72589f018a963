// <!--TITLE--> /*PLAN*/
// <!-- <script>
// </script><script>document.title = "broken"</script> <!-- <script> ]]> ${x} `
// žluťoučký kůň 漢字 🎉 \ " ' <b>
//@ group Gröüp </summary><b>"x"
uniform float constructor; //@ 0.5 [0, 1] unit=m²·"s" "what </script> it <b>is</b> &amp; does"
uniform float toString; //@ 0.25 [0, 1]
uniform float hasOwnProperty; //@ 2 [0.1, 100] log
uniform int t; //@ 3 [0, 9]
uniform bool paused; //@ on
uniform vec4 four; //@ 0.1,0.2,0.3,0.4 [0, 1]
uniform vec4 paint; //@ #11223344
uniform vec2 two; //@ 1,2
uniform int menu; //@ 1 {a & b, "c" <d>, e}
void mainImage(out vec4 c, in vec2 p) { c = vec4(constructor, toString, hasOwnProperty / 4.0, 1.0) + vec4(float(t) * 0.01, paused ? 0.1 : 0.0, four.x + paint.x + two.x*0.0 + float(menu)*0.0, 0.); }
