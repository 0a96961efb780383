# A QGIS style (QML) of a raster, with colours over its range of values:
# gdalinfo -json -mm FILE.tif | jq -r --arg name FILE --arg level 740 -f raster.jq
def colours: { # from low to high
  max_elevation: ["#f4f9fd", "#c6dbef", "#6baed6", "#2171b5", "#08306b"],
  max_depth: ["#f7fbff", "#c6dbef", "#6baed6", "#2171b5", "#08306b"],
  max_speed: ["#ffffcc", "#fed976", "#fd8d3c", "#e31a1c", "#800026"],
  height: ["#eaf4fc", "#9ecae1", "#3182bd", "#08306b", "#5a0f6b"],
  share: ["#ffffcc", "#fed976", "#fd8d3c", "#e31a1c", "#800026"],
  arrival: ["#b30000", "#fc8d59", "#fee08b", "#99d594", "#3288bd"],
  thickness: ["#f6e8c3", "#dfc27d", "#bf812d", "#8c510a", "#402000"]};
def hazard_classes: [[1, "#ffd92f", "below 1 m"], [2, "#f57c00", "1 m to 3 m"], [3, "#b30000", "above 3 m"]];
def rounded: if . == 0 then 0 else (fabs | log10 | floor) as $e | pow(10; 3 - $e) as $p | (. * $p | round) / $p end;

# Colours between the values; below the lowest nothing is drawn.
def ramp($low; $high; $unit):
  . as $colours
  | [range(length) | {colour: $colours[.], value: ($low + ($high - $low) * . / (($colours | length) - 1))}]
  | "<rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"0.85\" alphaBand=\"-1\" nodataColor=\"\" classificationMin=\"\($low)\" classificationMax=\"\($high)\">
      <rasterTransparency/>
      <rastershader>
        <colorrampshader colorRampType=\"INTERPOLATED\" classificationMode=\"1\" clip=\"1\" minimumValue=\"\($low)\" maximumValue=\"\($high)\" labelPrecision=\"2\">
" + (map("          <item value=\"\(.value)\" color=\"\(.colour)\" alpha=\"255\" label=\"\(@html "\(.value | rounded) \($unit)")\"/>\n") | add)
    + "        </colorrampshader>
      </rastershader>
    </rasterrenderer>";

def classes: "<rasterrenderer type=\"paletted\" band=\"1\" opacity=\"0.7\" alphaBand=\"-1\" nodataColor=\"\">
      <rasterTransparency/>
      <colorPalette>
        <paletteEntry value=\"0\" color=\"#ffffff\" alpha=\"0\" label=\"none\"/>
" + (map("        <paletteEntry value=\"\(.[0])\" color=\"\(.[1])\" alpha=\"255\" label=\"\(.[2])\"/>\n") | add)
    + "      </colorPalette>
    </rasterrenderer>";

def relief: "<rasterrenderer type=\"hillshade\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" nodataColor=\"\" azimuth=\"315\" angle=\"45\" zfactor=\"1\" multidirection=\"0\">
      <rasterTransparency/>
    </rasterrenderer>";

# Light on a slope is smooth only where the terrain is interpolated before.
def smooth: "<provider><resampling enabled=\"true\" zoomedInResamplingMethod=\"cubic\" zoomedOutResamplingMethod=\"bilinear\" maxOversampling=\"2\"/></provider>
    <resamplingStage>provider</resamplingStage>
    ";

.bands[0] as $band | ($band.unit // "") as $unit | ($name | sub("^envelope_"; "") | sub("^arrival_.*"; "arrival") | sub("^share_.*"; "share")) as $kind
# A raster without a value has no range.
| ($band.computedMin // 0) as $least | (if $kind == "share" then 1 else [$band.computedMax // 1, $least + 1e-6] | max end) as $high
| (if $kind == "max_elevation" then [$level | tonumber, $least] | if .[0] < $high then .[0] else .[1] end
   elif $kind == "thickness" then [$least, 0.5, $high / 2] | if .[0] > 0 then .[0] else ([.[1], .[2]] | min) end
   elif $kind == "max_depth" or $kind == "max_speed" or $kind == "height" then 0
   elif $kind == "share" then $high / 1000 else $least end) as $low
| "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version=\"3.22\" styleCategories=\"Symbology\">
  <pipe>
    " + (if $kind == "ground" then smooth else "" end) + (if $kind == "hazard" then hazard_classes | classes elif $kind == "ground" then relief
         else (colours[$kind] // error("no colours for \($name)")) | ramp($low; $high; $unit) end) + "
    <brightnesscontrast brightness=\"0\" contrast=\"0\" gamma=\"1\"/>
    <huesaturation saturation=\"0\"/>
    <rasterresampler maxOversampling=\"2\"/>
  </pipe>
  <blendMode>0</blendMode>
</qgis>"
