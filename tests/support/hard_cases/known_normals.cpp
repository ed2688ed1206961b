// Normals that a search may miss: pairs whose highest normal is hard to find, each with a normal that is known to be high.
#include <utility>

#include "supernormal/proximity/proximity.hpp"
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

/// The rotation with these rows.
Matrix3 rows(const Vector3& x, const Vector3& y, const Vector3& z) {
  Matrix3 rotation;
  rotation << x.transpose(), y.transpose(), z.transpose();
  return rotation;
}

/// Body 1 is at the origin.
KnownNormal known(HardCase bodies, const Vector3& higher, double tolerance = Settings().tolerance) {
  return {std::move(bodies), higher, tolerance};
}

}  // namespace

std::vector<KnownNormal> known_normals() {
  std::vector<KnownNormal> all;
  all.push_back(known(pair("an octahedron's tip 1e-13 m beside the rim of a cylinder's face, as exactly as can be",
                           "the way from the face's normal to the maximum is a narrow ridge, along which the tip keeps to the rim",
                           superellipsoid(Vector3(0.99177535343395917, 0.6734340285826611, 0.63517434717434995), 1.0635460553378775,
                                          1.0501094799923516),
                           cylinder(0.62322465858321741, 0.53309284841699722),
                           at(Vector3(-0.12861393808765478, -0.46556061492126743, 1.2979780352034169),
                              rows({-0.27555679152977963, -0.95466164277940357, 0.11264813557065266},
                                   {0.94615240182235938, -0.24863945927753317, 0.20730183746401432},
                                   {-0.16989434118767549, 0.1637057332407954, 0.97176969788962819}))),
                      Vector3(0.0018890292406196988, -0.12258626522473433, 0.99245606408887399), 1e-15));
  all.push_back(known(pair("an octahedron's tip in another's, 5e-5 m deep", "the highest normal is hard to find",
                           superellipsoid(Vector3(0.91855717191001063, 1.3217171393909011, 1.1310303975172471), 1.0300559655732762,
                                          1.2974700621527924),
                           superellipsoid(Vector3(0.622859106567343, 1.0872184036498354, 0.65620711217128369), 1.1469974323738119,
                                          1.0424575813281118),
                           at(Vector3(0.15863829289317419, 0.3088316963572888, -1.68781275982544),
                              rows({-0.11036972297795322, -0.96404102904540079, 0.24175073643497932},
                                   {-0.85549105740384157, 0.21596197031427722, 0.47063306097216806},
                                   {-0.50591854576782136, -0.15487195257715358, -0.84856414215609721}))),
                      Vector3(0.026188684787260982, -0.0038348958641832766, -0.99964966181298953)));
  all.push_back(known(pair("the tips of two needles, 1e-3 m apart, roughly", "the highest normal is hard to find",
                           superellipsoid(Vector3(1, 1e-4, 1e-4), 1.3, 1.3), superellipsoid(Vector3(1, 1e-4, 1e-4), 1.3, 1.3),
                           at(Vector3(1.1836744101086172, 0.081632935277476476, -0.97959202487887065),
                              rows({0.1837839537266481, -0.65285537721130771, -0.7348491782664538},
                                   {0.080714889249705463, -0.73503534204003285, 0.6732073622632927},
                                   {-0.97964716352675107, -0.18303798075364971, -0.082392551821251311}))),
                      Vector3(0.00076949776623643211, 0.99820503945868144, 0.059960258561240709), 1e-3));
  all.push_back(known(pair("a vertex deep in another's, one without a Hessian, where s is level at the normal of both",
                           "below an exponent of 2 the radius of curvature vanishes at the vertex, though a few degrees beside it "
                           "is as large as the overlap of 0.27 m",
                           superellipsoid(Vector3(1.4, 0.6, 0.7), 1.45, 1.35).by_callbacks(),
                           superellipsoid(Vector3(0.65, 0.65, 0.65), 1.85, 1.8), at(Vector3(0, 0, 1.08))),
                      Vector3(0, 4e-3, 1).normalized(), 1e-6));
  all.push_back(
      known(pair("an octahedron's tip in another's, 1e-6 m deep: s rises on beyond a shelf", "the highest normal is hard to find",
                 superellipsoid(Vector3(0.56749216029451766, 0.65252412836825313, 1.0201018585264015), 1.1060605934645005,
                                1.1584072967469143),
                 superellipsoid(Vector3(0.80102906096941917, 0.83995622940094428, 1.3256164648197444), 1.0926718750416728,
                                1.1225894973559909),
                 at(Vector3(-0.27482087727222648, 1.8876698889875803, 0.39515110932644842),
                    rows({0.27594973644575649, -0.93854781889435079, 0.20731554356626114},
                         {-0.23663711153651806, -0.27539009682028381, -0.93175274188862367},
                         {0.93158715126346114, 0.20805837215063339, -0.29808906953938696}))),
            Vector3(-0.11966945393755965, 0.99272824452624409, -0.013032816814794776).normalized()));
  all.push_back(
      known(pair("a vertex in another's, both aligned: the higher normal is beside the plane of symmetry",
                 "on the plane of symmetry the radius of curvature across is infinite. The valley beside it is 4e-14 m deep",
                 superellipsoid(Vector3(0.68110536473488115, 0.72987765699106344, 1.1571889241910578), 2.2772102576920141,
                                1.3239459675164147),
                 superellipsoid(Vector3(1.3578682070477115, 0.51462979531380537, 1.0175208230541066), 2.1587757296700878,
                                1.3244589589248879),
                 at(Vector3(1.7203305966049489e-245, 0, -2.1388302183892409))),
            Vector3(0.11064053130300258, -0.00026959619485366823, -0.99386045310706868).normalized()));
  all.push_back(known(pair("a vertex in another's with an aligned plane, of exponent 2.03", "the highest normal is hard to find",
                           superellipsoid(Vector3(1.1839660575572710, 0.86145032376977526, 1.2536389550690261), 1.696455721666096,
                                          3.0301289565502225),
                           superellipsoid(Vector3(0.59437843469356066, 0.84535615134282127, 0.9057917618317004), 2.0333247847664837,
                                          1.4338876670117855),
                           at(Vector3(0.59200751351479552, 0, -1.8542009286189103))),
                      Vector3(0.33562441923301023, 0.00026959619485366807, -0.94199584740719344).normalized()));
  all.push_back(
      known(pair("a vertex of flat cross-section 1.3e-4 m beside a rim, 0.03 m apart, from a first normal",
                 "on the body's plane of symmetry through the vertex the curvature is infinite: the cross-section is flat there",
                 superellipsoid(Vector3(1.3444236321789771, 1.2687551262821948, 0.75405833063231809), 4.1731844300678489,
                                1.6727896210524513),
                 cylinder(0.55835664257566964, 1.4455460299454355), at(Vector3(0.5584875288002276, 0, -2.229637531232395))),
            Vector3(9.5121223673043051e-4, 0, -1).normalized(), 1e-9));
  all.back().bodies.first_normal = Vector3(0, -3.1225022567582522e-17, -1);
  all.push_back(known(
      pair("the flat flank of a wedge, 1e-6 m deep, roughly", "the normals of the flank are no less oblique than those beside it",
           superovoid(Vector3(1.1232843154375776, 1.0737125999467814, 1.3603350229379723), 96.789101125327065, 51.108946132402053,
                      -0.86192709793125488, -0.86192709793125488),
           superellipsoid(Vector3(1.2844175381082685, 1.306028872199287, 0.83400576432826423), 194.759665910069, 165.9256888675242),
           at(Vector3(-3.3102648273279733, 0, -0.44601633155738651))),
      Vector3(-0.83708036827081067, 0, 0.5470799366231629).normalized(), 1e-3));
  all.push_back(
      known(pair("a box's face in a rounded box, a corner on the point of deepest overlap",
                 "the higher normal lies in a sector of 13 degrees that the corner and the curvature of body 2 leave open",
                 box(Vector3(1.1660950384963529, 0.72469453895462166, 0.73200031560061518)),
                 superellipsoid(Vector3(0.62279166333149438, 1.1619196180367359, 0.95281948862489751), 13.003417479094304,
                                13.200392857275245),
                 at(Vector3(0.77430913997328865, -1.3809558138809053, 0.075666024650725805),
                    rows({0.99642066774186167, -0.083052674190769615, 0.015751387450774222},
                         {0.082607833392310842, 0.9962148244576462, 0.027054932878300166},
                         {-0.017938750209832037, -0.025656906294075792, 0.99950984207276627}))),
            Vector3(0.025443651949511002, -0.99967625788325709, 0)));
  all.push_back(known(pair("an edge 1e-10 m beside a sharp edge, roughly", "the Hessians of both together are singular",
                           superellipsoid(Vector3(0.21666307587024122, 3.6158533257603551, 0.11532860785825504), 40.062935138090054,
                                          1.0792247408227613),
                           superellipsoid(Vector3(0.19253172420533454, 0.058907870595482748, 2.7634213402497263),
                                          1.1271104401069829, 21.152693960353741),
                           at(Vector3(-0.072210820061288775, 1.8844153238752522e-96, 2.8787499481517842))),
                      Vector3(-3.4058259826811749e-12, 2.2756156744483055e-12, 1).normalized(), 1e-6));
  all.push_back(known(
      pair("a corner in a vertex, as exactly as can be", "the higher normal is beside a plane of symmetry, beyond a flat spot",
           superellipsoid(Vector3(0.52554206102025414, 0.83316697474825452, 0.78785238828638682), 3.4703594224672014,
                          1.8464279827519052),
           polytope({{-0.54408017368739625, -0.36252818257541258, 0.54490908100436164},
                     {-0.24351223576300035, 0.46439424406273994, -0.76527789844398875},
                     {-0.53563804370789536, 0.85613227427299365, 0.30437629946436739},
                     {-0.07285769327911723, 0.24518860226374653, -0.84523119649012446},
                     {0.39488090161396705, 1.2142738789418013, -0.047077986536997261},
                     {0.48329130127324865, 1.0198191935809111, -0.23233668034519162},
                     {0.054345315270567837, -1.3278005926221204, 0.32325675064725645},
                     {-0.37878573179238245, -1.0008266874730412, 0.43499430644776049},
                     {0.59058060138856427, -0.86869234533482997, -0.03806605888752309}}),
           at(Vector3(0.60205893002055633, 0.33784090103628367, -1.8963280040565076),
              rows({-0.53502026478923392, 0.58087693147475083, 0.61346174024574307},
                   {-0.72473216621283987, 0.057615062234709358, -0.686617646044824},
                   {-0.43418498767380559, -0.8119498106928581, 0.39015497099810115}))),
      Vector3(-0.00024668335069741776, 0, -0.99999996957366177).normalized(), 1e-15));
  all.push_back(known(pair("a vertex in another's, both aligned, as exactly as can be", "the highest normal is hard to find",
                           superellipsoid(Vector3(0.57203485562414891, 0.76277235741676308, 0.92616675512158864),
                                          2.6668881112077267, 1.3610710001802806),
                           superellipsoid(Vector3(1.127045154361791, 0.64816896238249311, 1.4366196281302175), 2.5332381855400752,
                                          1.5172853770292629),
                           at(Vector3(4.8030307629651573e-78, 0, 2.3627514571166595))),
                      Vector3(0, 1.3e-4, 1).normalized(), 1e-15));
  all.push_back(known(pair("a tip in another's on a plane of symmetry, one without a Hessian, as exactly as can be",
                           "a climb without Hessians never leaves the plane of symmetry; the higher normals are beside it",
                           superellipsoid(Vector3(1.1976799266823006, 1.4678420773793968, 1.1317300192116135), 1.099513568331888,
                                          1.0891374371824021),
                           superellipsoid(Vector3(0.71069922106741223, 0.8550989526781152, 0.76620464401737687), 1.1075104548092869,
                                          1.0839127766190946)
                               .by_callbacks(),
                           at(Vector3(-1.4870757940284762e-05, 0, -1.8977714545552284))),
                      Vector3(-0.36945406351785925, -0.017251487790557775, -0.92908884457793051).normalized(), 1e-15));
  all.push_back(known(pair("a tip 4e-3 m in another's on a plane of symmetry, one without a Hessian",
                           "a climb without Hessians never leaves the plane of symmetry; the higher normals are beside it",
                           superellipsoid(Vector3(0.81757743587363507, 0.68871264031956192, 1.4692079216437368), 1.2514406145657626,
                                          1.2499679480491082)
                               .by_callbacks(),
                           superellipsoid(Vector3(1.1290488587151037, 1.177097030217231, 0.72951507342204369), 1.2123675543641061,
                                          1.1443616755496395),
                           at(Vector3(-1.9426633332601377, 9.0687214274906894e-05, 0))),
                      Vector3(-0.9827693063605325, 0.1741329996797667, 0.06198539261926516).normalized()));
  all.push_back(known(pair("tips 7e-7 m in one another", "the highest normal is hard to find",
                           superellipsoid(Vector3(0.50326613865884384, 1.0568669013476841, 0.51857686814809989), 1.1727767667760731,
                                          1.2095160897887847),
                           superellipsoid(Vector3(0.83732890384385839, 0.91107346864219874, 0.62580652304072482),
                                          1.0653498347159143, 1.1008722365792472),
                           at(Vector3(-0.058312369954986558, -1.9248125166005612, -0.27078365350588579),
                              rows({-0.077923840745364403, 0.06400408408976721, -0.9949026848206417},
                                   {-0.2921443038375427, 0.95266331368320256, 0.084168381815367496},
                                   {0.95319440870095784, 0.29721387582340425, -0.055536755750236422}))),
                      Vector3(-0.12109870914216911, -0.99237659019579172, 0.022886805707089085).normalized()));
  all.push_back(known(pair("a vertex on the flat face of a body with sharp sections, 8e-6 m deep",
                           "on the edge that runs across the flat face the other body alone has curvature",
                           superellipsoid(Vector3(1.030940572922143, 0.38535300024164493, 1.1378309966684093), 1.0593776794536642,
                                          34.741461447676919),
                           superellipsoid(Vector3(0.071474949631092466, 0.48221039359232187, 1.1589073745573089),
                                          25.705595144452086, 33.378091905101051),
                           at(Vector3(-0.08147749049243419, -0.57554311779767175, -2.0616662747530721),
                              rows({-0.85014306083360847, -0.091352506938197686, -0.51856677062126677},
                                   {0.37870617758095831, 0.57816718550504276, -0.72270625890966034},
                                   {0.36583931879786058, -0.81078815055554665, -0.4569290620438069}))),
                      Vector3(2.5898606379237307e-11, 3.5753877485270148e-15, -1), 1e-12));
  all.push_back(known(pair("two vertices 6e-5 m deep, one without a Hessian", "the highest normal is hard to find",
                           superellipsoid(Vector3(3.6481008700558961, 0.96722482379045194, 1.6659483633181225), 1.0206295723104579,
                                          1.1956914668550584),
                           superellipsoid(Vector3(3.0001153728424068, 1.1355572910356881, 0.4782677563915374), 6.5218037073853559,
                                          1.0917067125451516)
                               .by_callbacks(),
                           at(Vector3(0, -1.141392209335566e-83, 2.1441574564401087))),
                      Vector3(0.022255175878533217, 0.01725211919830108, 0.99960345714177246)));
  all.push_back(
      known(pair("a flat face with sharp sections on the edge of a box, 0.02 m deep, roughly",
                 "the boundary point has to go to the other side of the face, where the normal is 1e9 times longer",
                 box(Vector3(0.47784297674797016, 0.65302903466481943, 0.22920610074731182)),
                 superellipsoid(Vector3(0.11336965305275699, 0.079491480016105079, 0.32449042002615075), 1.0233096024762385,
                                24.139544178189325),
                 at(Vector3(-0.47131072778774796, 0.7040171837470226, 0.53332971930557793),
                    rows({1, -6.2118231113173759e-15, 1.1068064658725494e-14}, {6.2118231113173759e-15, 1, 5.7905581527147752e-14},
                         {-1.1068064658725494e-14, -5.7905581527147752e-14, 1}))),
            Vector3(1.5777218104420236e-30, 0.00014091724309110162, 0.99999999007116525), 1e-06));
  all.push_back(
      known(pair("two vertices 8e-10 m deep in a plane of symmetry, as exactly as can be", "the highest normal is hard to find",
                 superellipsoid(Vector3(0.71296597701132092, 1.0984066824783172, 1.2564937760469683), 2.1866296579336773,
                                1.1656328954301227),
                 superellipsoid(Vector3(0.8643055585049727, 0.63328599533611518, 0.64187401040155534), 5.8091326116798934,
                                1.0242328952401158),
                 at(Vector3(-1.1627542430364399e-293, -1.8495011756912983e-44, 1.8983677856457835))),
            Vector3(0.017251487790557775, -0.014999836257381292, 0.99973866139169798), 1e-15));
  all.push_back(
      known(pair("a vertex on the edge of a flat body, 3 mm apart, roughly",
                 "the vertex has no curvature, and the sum of the Hessians is singular",
                 superellipsoid(Vector3(1.1178312846124669, 0.51561299252521375, 0.51937387119980405), 1.0652712251839331,
                                1.0215371823428434),
                 superellipsoid(Vector3(0.71620011118264004, 1.1120671328332621, 0.70715741219632777), 1.1103482903243858,
                                27.762210538656923),
                 at(Vector3(-1.8372468168903395, 1.1378993825478028e-09, 0.34220721523305458),
                    rows({1, -6.1993818575992063e-11, -3.7097851271000378e-09}, {6.1993818575992063e-11, 1, 3.4549223408892584e-09},
                         {3.7097851271000378e-09, -3.4549223408892584e-09, 1}))),
            Vector3(-1, -5.8060051358934491e-11, -3.7089860453520994e-09), 0.001));
  all.push_back(known(pair("two vertices 7e-5 m deep, which is touching at a tolerance of 1e-3",
                           "the bodies lie in a plane of symmetry, across which s rises by 1e-11 m",
                           superellipsoid(Vector3(0.11645783548106431, 2.4097850836256174, 3.7581784826603002), 6.9791411274972592,
                                          1.4020841648050002),
                           superellipsoid(Vector3(0.18130680519995129, 0.35383931455754919, 2.7654579675288851), 3.1730775455599707,
                                          1.3633620187714195),
                           at(Vector3(0, -2.249389875078415e-175, -6.5235634541623426))),
                      Vector3(0.00091420995426320527, -0.0013422656972313872, -0.9999986812706092), 0.001));
  all.push_back(
      known(pair("two vertices 4e-11 m deep in a plane of symmetry, as exactly as can be", "the highest normal is hard to find",
                 superellipsoid(Vector3(0.083500117213317529, 0.27034240319537822, 0.33815383651540687), 6.4896649402147784,
                                1.1200456333232491),
                 superellipsoid(Vector3(0.5822860238970049, 0.61871970214654037, 2.3773906283478077), 2.4810988125375477,
                                1.0388081242131137),
                 at(Vector3(0, 0, -2.7155444648244416))),
            Vector3(-0.068846383593012608, -0.045488133276259619, -0.99658968748287025), 1e-15));
  all.push_back(
      known(pair("a vertex on the flat face of a body with sharp sections, 4e-7 m apart", "the face's normal is 1e-16 radians away",
                 superellipsoid(Vector3(1.0968711739033943, 1.2205116845305606, 0.61068835487633155), 1.6718304010667231,
                                1.2267469604494341),
                 superellipsoid(Vector3(1.0892623070016809, 0.63655134727433182, 0.54121846194456191), 1.0830174080538395,
                                27.712594570880636),
                 at(Vector3(0.18593709788279633, 0.21301592457420146, 1.1519072546254689),
                    rows({1, -9.5158382905507688e-10, -1.499019689158299e-09}, {9.5158382905507688e-10, 1, -2.7125396802693259e-09},
                         {1.499019689158299e-09, 2.7125396802693259e-09, 1}))),
            Vector3(-1.4987088000765559e-09, -2.7115639284149797e-09, 1)));
  all.push_back(
      known(pair("a flat face over the rim of a cylinder's, 0.45 m deep", "the rim turns with the normal",
                 cylinder(1.0979394073019821, 0.71983868197042333),
                 superellipsoid(Vector3(0.86260385789933769, 1.2021586798719865, 0.65618464877373561), 3.5958757029430406,
                                24.681786908287489),
                 at(Vector3(3.086631071982804e-05, 1.7690162354891643, 0.92934154071868524),
                    rows({1, -3.9998084524971387e-12, 7.7515228887151997e-13}, {3.9998084524971387e-12, 1, 3.3162752699290716e-12},
                         {-7.7515228887151997e-13, -3.3162752699290716e-12, 1}))),
            Vector3(2.6355589508012911e-09, 1.6874129755854321e-08, 1)));
  all.push_back(known(pair("a hull's vertex on an octahedron's, 8e-12 m apart",
                           "stationary normals that overlap by x prove that the bodies are apart by x at most: an error of 2 x",
                           superellipsoid(Vector3(0.74453053912027789, 0.072705323041119041, 0.54749995190721934),
                                          1.0260603913822577, 1.1912751495901868),
                           polytope({{1.4200568409671477, 0.24163743461210851, 0.62289541211636779},
                                     {3.2223119914719804, 0.10747778089537707, 0.51692730814796817},
                                     {-3.015213236572412, 0.27445764032582692, 0.35138200777010009},
                                     {2.5160850941496462, -0.29336602399189854, -0.42056752358315025},
                                     {1.9244694962840889, 0.085965760966722149, 0.69497330136611379},
                                     {-1.6475957483028896, -0.083351436831516981, -0.71724302559514252}}),
                           at(Vector3(3.7597437756014189, -0.27445764027461134, -0.35138200777010009))),
                      Vector3(0.41988718925872698, 0.90757568476404937, -0.0010605288646612805)));
  all.push_back(known(pair("two vertices 0.3 m deep, one rounded by more",
                           "the rounding alone makes the ball that rolls inside larger than the depth",
                           superellipsoid(Vector3(0.75020885837032969, 0.56126955248933097, 0.79438063826842731),
                                          14.367008308971478, 1.0296390914127906),
                           superellipsoid(Vector3(0.97093659407752342, 0.77314113588424216, 0.82905632006157925),
                                          38.275814949299004, 1.0294709613500304)
                               .rounded(0.32642319486154348),
                           at(Vector3(-0.21819029114406707, 1.7405965759783339, 0.23933930873252007),
                              rows({-0.69154123213076168, 0.58013661176606768, -0.43036291191464787},
                                   {0.60098447274173938, 0.79262666883092137, 0.10276491318212946},
                                   {0.4007348098011973, -0.1875752530228437, -0.89678711892344576}))),
                      Vector3(0, 1, 0)));
  all.push_back(known(pair("a capsule beside the middle of a straight edge, 4e-10 m deep, roughly",
                           "the edge has a radius of curvature of 1e25 m along it and none across: their product underflows",
                           capsule(1.039566531540991, 0.60582679202828615),
                           superellipsoid(Vector3(0.7961136857396045, 1.0449256329504066, 0.69308873942693749), 1.1795511311578175,
                                          6.2669868485077007),
                           at(Vector3(1.8325450754306534, 0, 1.0124673911576891))),
                      Vector3(0.99923211927039435, 0, 0.039181268718564581), 0.001));
  all.push_back(known(pair("an octahedron's edge on a box's corner, touching, roughly", "the highest normal is hard to find",
                           superellipsoid(Vector3(0.87373635023403262, 0.6062102633550237, 0.8297598022203857), 1.0257828759412819,
                                          16.85941093358095),
                           superellipsoid(Vector3(0.6811536568308767, 0.92634438046295964, 0.68402914136415371), 29.825528743207627,
                                          35.541626221006688),
                           at(Vector3(0.11107877809261585, -0.6066997250575441, -2.1132357158728103),
                              rows({-0.61420523592985932, -0.6452863244335143, 0.45426587771417626},
                                   {-0.60033504821249895, 0.0084469368904593889, -0.79970399470358089},
                                   {0.51220089617653164, -0.76389410833979721, -0.39257614955534925}))),
                      Vector3(-0.0034127411937361243, -0.034269906843272843, -0.99940678739064903), 0.001));
  return all;
}

}  // namespace supernormal::samples
