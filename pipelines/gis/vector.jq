# Styles (QML) of the layers of wave.gpkg as rows of the table layer_styles, from which QGIS takes them; as GeoJSON for
# ogr2ogr: jq -n --arg runup 17.4 -f vector.jq
def properties: to_entries | map("<prop k=\"\(.key)\" v=\"\(@html "\(.value)")\"/>") | join("");
def symbol($type; $class; $settings; $name):
  "<symbol type=\"\($type)\" name=\"\($name)\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\"><layer class=\"\($class)\" enabled=\"1\" locked=\"0\" pass=\"0\">" +
  ($settings | properties) + "</layer></symbol>";
def line($colour; $width; $style; $name):
  symbol("line"; "SimpleLine"; {line_color: $colour, line_width: $width, line_width_unit: "MM", line_style: $style, capstyle: "round", joinstyle: "round"}; $name);
def fill($colour; $edge; $width; $name):
  symbol("fill"; "SimpleFill"; {color: $colour, style: "solid", outline_color: $edge, outline_width: $width, outline_width_unit: "MM", outline_style: (if $width == 0 then "no" else "solid" end)}; $name);
def single: "<renderer-v2 type=\"singleSymbol\" symbollevels=\"0\" enableorderby=\"0\" forceraster=\"0\"><symbols>\(.)</symbols></renderer-v2>";
# Each class is a value, its label and its symbol, named by its place.
def categories($attribute): . as $classes
  | "<renderer-v2 type=\"categorizedSymbol\" attr=\"\($attribute)\" symbollevels=\"0\" enableorderby=\"0\" forceraster=\"0\"><categories>" +
    ([range(length) | "<category value=\"\($classes[.].value)\" symbol=\"\(.)\" label=\"\(@html "\($classes[.].label)")\" render=\"true\"/>"] | add) +
    "</categories><symbols>" + (map(.symbol) | add) + "</symbols></renderer-v2>";
def graduated($attribute; $top; $unit): . as $colours | length as $n
  | "<renderer-v2 type=\"graduatedSymbol\" attr=\"\($attribute)\" graduatedMethod=\"GraduatedColor\" symbollevels=\"0\" enableorderby=\"0\" forceraster=\"0\"><ranges>" +
    ([range($n) | [$top * . / $n, $top * (. + 1) / $n] as [$low, $high]
      | "<range lower=\"\(if . == 0 then -1 else $low end)\" upper=\"\($high)\" symbol=\"\(.)\" label=\"\($low * 100 | round / 100) - \($high * 100 | round / 100) \($unit)\" render=\"true\"/>"] | add) +
    "</ranges><symbols>" + ([range($n) | line($colours[.]; 1.2; "solid"; .)] | add) + "</symbols></renderer-v2>";
def labels($expression): "<labeling type=\"simple\"><settings calloutType=\"simple\"><text-style fontFamily=\"DejaVu Sans\" fontSize=\"9\" fontSizeUnit=\"Point\" textColor=\"40,0,60,255\" isExpression=\"1\" fieldName=\"\(@html "\($expression)")\"><text-buffer bufferDraw=\"1\" bufferSize=\"0.8\" bufferSizeUnits=\"MM\" bufferColor=\"255,255,255,255\"/></text-style><placement placement=\"1\" dist=\"1.5\" distUnits=\"MM\" quadOffset=\"2\"/><rendering obstacle=\"1\" scaleVisibility=\"0\" drawLabels=\"1\"/></settings></labeling>";
def style($body; $labelled): "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'><qgis version=\"3.22\" styleCategories=\"Symbology|Labeling\" labelsEnabled=\"\($labelled)\">\($body)<blendMode>0</blendMode></qgis>";

# Never of zero width: QGIS would draw nothing.
([($runup | tonumber? // 1), 0.001] | max) as $top
| {
  gauges: style((symbol("marker"; "SimpleMarker"; {name: "circle", color: "122,46,140,255", outline_color: "255,255,255,255", size: 2.6, size_unit: "MM"}; 0) | single) +
    labels("\"name\" || coalesce(': ' || round(\"max_height_m\", 1) || ' m', '')"); 1),
  shoreline: style(line("11,60,102,255"; 0.5; "dash"; 0) | single; 0),
  shore_runup: style(["255,237,160,255", "254,178,76,255", "240,94,35,255", "189,0,38,255", "94,0,50,255"] | graduated("runup_m"; $top; "m"); 0),
  inundation: style([{value: 1, label: "lake at rest", symbol: fill("158,202,225,130"; "33,113,181,255"; 0; 0)},
                     {value: 2, label: "inundated land", symbol: fill("222,45,38,120"; "165,15,21,255"; 0.3; 1)}] | categories("class"); 0),
  hazard: style([{value: 1, label: "below 1 m", symbol: fill("255,217,47,190"; "0,0,0,0"; 0; 0)},
                 {value: 2, label: "1 m to 3 m", symbol: fill("245,124,0,190"; "0,0,0,0"; 0; 1)},
                 {value: 3, label: "above 3 m", symbol: fill("179,0,0,190"; "0,0,0,0"; 0; 2)}] | categories("class"); 0)}
| {type: "FeatureCollection", features: (to_entries | map({type: "Feature", geometry: null, properties: {
    f_table_catalog: "", f_table_schema: "", f_table_name: .key, f_geometry_column: "geom", styleName: .key, styleQML: .value, styleSLD: "",
    useAsDefault: true, description: "", owner: "", ui: "", update_time: "2000-01-01T00:00:00.000Z"}}))}
