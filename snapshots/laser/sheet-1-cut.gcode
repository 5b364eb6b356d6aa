; stargrip-cam cut program
; name: laser
; program: purpose=cut sheet=1 stars=1
; frame: origin at lower left of the sheet, Z0 on the upper sheet
; cutting: speed_mm_s=12 height_mm=11
; cutting: tool=laser power_percent=62.5
; machine: dialect=grbl heating=laser arcs=yes line=72
; heights: contact_mm=12 travel_mm=13 park_mm=30 ramp_mm=3
; path: tolerance_mm=0.001 travel_mm_s=20 dwell=s
; laser: full_power_S=1000 focus_mm=11
; laser-ramps: acceleration_mm_s2=500
; requires: $32=1, laser mode: no beam in G0 and at rest
; requires: $30=1000, the S of full power
; safety: goggles for the wavelength on, for everybody in the room
; safety: enclosure closed, fumes drawn off, never alone: it sets fire
; safety: no PVC and no vinyl: their fumes are toxic and corrode
; requires: $1=255 so that the motors hold at every stop
; requires: the laser must be dark when the controller starts
; length: cut=1 edge=registration-1 length_mm=10.425 time_s=1
; length: cut=2 edge=registration-2 length_mm=10.425 time_s=1
; length: cut=3 edge=registration-3 length_mm=10.425 time_s=1
; length: cut=4 edge=cut-hole-1 length_mm=160.257 time_s=14
; length: cut=5 edge=cut-outside-1 length_mm=338.591 time_s=29
; total: length_mm=530.123 time_s=65
M5
G21
G17
G91.1
G90
G94
G0 Z30
; tool: tool=laser power_percent=62.5
; keep the sheet where it is, nothing that burns under it
; goggles on, enclosure closed, fumes drawn off, press start
M0
G0 X14.3742 Y61.9561
G0 Z13
; cut: cut=1 edge=registration-1 length_mm=10.425 time_s=1
M4 S0
; progress: percent=6 remaining_s=61
G3 X12.9395 Y61.8543 Z12 I-0.6242 J-1.364 F720
G3 X12.25 Y60.5921 Z11 I0.8105 J-1.2622
G3 X13.75 Y59.0921 I1.5 J0 S625
G3 X15.25 Y60.5921 I0 J1.5
; progress: percent=7 remaining_s=61
G3 X13.75 Y62.0921 I-1.5 J0
G3 X12.25 Y60.5921 I0 J-1.5
G3 X12.5712 Y59.6646 I1.5 J0.0001
G3 X13.8936 Y59.099 Z12 I1.1789 J0.9275 S0
; progress: percent=8 remaining_s=60
G3 X15.084 Y59.9062 Z13 I-0.1436 J1.4931
M5
G0 X17.7081 Y52.7963
G0 Z13
; cut: cut=2 edge=registration-2 length_mm=10.425 time_s=1
M4 S0
; progress: percent=9 remaining_s=59
G3 X16.2734 Y52.6946 Z12 I-0.6243 J-1.3639 F720
G3 X15.5839 Y51.4324 Z11 I0.8105 J-1.2622
G3 X17.0839 Y49.9324 I1.5 J0 S625
G3 X18.5839 Y51.4324 I0 J1.5
; progress: percent=10 remaining_s=59
G3 X17.0839 Y52.9324 I-1.5 J0
G3 X15.5839 Y51.4324 I0 J-1.5
G3 X15.905 Y50.5048 I1.5 J-0.0001
G3 X17.2275 Y49.9393 Z12 I1.1788 J0.9276 S0
; progress: percent=11 remaining_s=58
G3 X18.4179 Y50.7465 Z13 I-0.1436 J1.4931
M5
G0 X92.2004 Y17.0231
G0 Z13
; cut: cut=3 edge=registration-3 length_mm=10.425 time_s=1
M4 S0
; progress: percent=17 remaining_s=54
G3 X90.7657 Y16.9213 Z12 I-0.6242 J-1.364 F720
G3 X90.0762 Y15.6591 Z11 I0.8105 J-1.2622
G3 X91.5762 Y14.1591 I1.5 J0 S625
G3 X93.0762 Y15.6591 I0 J1.5
; progress: percent=18 remaining_s=53
G3 X91.5762 Y17.1591 I-1.5 J0
G3 X90.0762 Y15.6591 I0 J-1.5
G3 X90.3974 Y14.7316 I1.5 J0.0001
G3 X91.7198 Y14.166 Z12 I1.1789 J0.9275 S0
; progress: percent=19 remaining_s=53
G3 X92.9102 Y14.9732 Z13 I-0.1436 J1.4931
M5
G0 X79.5294 Y71.3487
G0 Z13
; cut: cut=4 edge=cut-hole-1 length_mm=160.257 time_s=14
M4 S0
; progress: percent=23 remaining_s=50
G1 X79.7908 Y74.3373 Z11 F720
; progress: percent=24 remaining_s=49
G1 X80.1612 Y78.5704 S625
G1 X80.5315 Y82.8035
; progress: percent=25 remaining_s=49
G1 X80.9019 Y87.0366
G1 X77.4211 Y84.5994
; progress: percent=26 remaining_s=48
G1 X73.9403 Y82.1621
G1 X70.4595 Y79.7248
; progress: percent=27 remaining_s=47
G1 X66.9787 Y77.2875
; progress: percent=28 remaining_s=47
G1 X63.4978 Y74.8502
G1 X60.017 Y72.4129
; progress: percent=29 remaining_s=46
G2 X58.2055 Y71.367 I-6.883 J9.8297
G1 X54.3544 Y69.5712
G1 X50.5032 Y67.7754
; progress: percent=30 remaining_s=45
G1 X46.6521 Y65.9796
G1 X42.8009 Y64.1838
; progress: percent=31 remaining_s=45
G1 X38.9498 Y62.3879
; progress: percent=32 remaining_s=44
G1 X35.0986 Y60.5921
G1 X38.9498 Y58.7963
; progress: percent=33 remaining_s=44
G1 X42.8009 Y57.0005
G1 X46.6521 Y55.2046
; progress: percent=34 remaining_s=43
G1 X50.5032 Y53.4088
G1 X54.3544 Y51.613
; progress: percent=35 remaining_s=42
G1 X58.2055 Y49.8172
G2 X60.017 Y48.7713 I-5.0715 J-10.8756
; progress: percent=36 remaining_s=42
G1 X63.4978 Y46.334
G1 X66.9787 Y43.8967
; progress: percent=37 remaining_s=41
G1 X70.4595 Y41.4594
G1 X73.9403 Y39.0221
; progress: percent=38 remaining_s=40
G1 X77.4211 Y36.5849
G1 X80.9019 Y34.1476
; progress: percent=39 remaining_s=40
G1 X80.5315 Y38.3807
G1 X80.1612 Y42.6138
; progress: percent=40 remaining_s=39
G1 X79.7908 Y46.8469
; progress: percent=41 remaining_s=38
G1 X79.4205 Y51.08
G1 X79.0501 Y55.3131
; progress: percent=42 remaining_s=38
G1 X78.6798 Y59.5462
G2 X78.6798 Y61.638 I11.9543 J1.0459
G1 X79.0501 Y65.8711
; progress: percent=43 remaining_s=37
G1 X79.4205 Y70.1042
; progress: percent=44 remaining_s=37
G1 X79.7908 Y74.3373
G1 X79.878 Y75.3335
G1 X80.1395 Y78.3221 Z13 S0
M5
G0 X63.8293 Y100.7186
G0 Z13
; cut: cut=5 edge=cut-outside-1 length_mm=338.591 time_s=29
M4 S0
; progress: percent=46 remaining_s=35
G1 X61.3719 Y98.9978 Z11 F720
; progress: percent=47 remaining_s=34
G1 X58.1831 Y96.7651 S625
G1 X54.9944 Y94.5323
; progress: percent=48 remaining_s=34
G1 X51.8057 Y92.2995
G1 X48.6169 Y90.0667
; progress: percent=49 remaining_s=33
G1 X44.5849 Y88.1866
G1 X40.5529 Y86.3064
; progress: percent=50 remaining_s=32
G1 X36.5209 Y84.4263
; progress: percent=51 remaining_s=32
G1 X32.4889 Y82.5461
G1 X28.4569 Y80.666
; progress: percent=52 remaining_s=31
G1 X24.4249 Y78.7858
G1 X20.3929 Y76.9056
; progress: percent=53 remaining_s=30
G3 X16.5641 Y74.4924 I7.6071 J-16.3135
G3 X13.4582 Y71.2005 I11.4356 J-13.9006
; progress: percent=54 remaining_s=30
G3 X11.2717 Y67.2378 I14.5418 J-10.6083
; progress: percent=55 remaining_s=29
G3 X10.1428 Y62.855 I16.7283 J-6.6456
G3 X10.1428 Y58.3292 I17.8572 J-2.2629
; progress: percent=56 remaining_s=29
G3 X11.2717 Y53.9464 I17.8572 J2.2628
G3 X13.4582 Y49.9838 I16.7282 J6.6458
; progress: percent=57 remaining_s=28
G3 X16.5641 Y46.6918 I14.5417 J10.6085
; progress: percent=58 remaining_s=27
G3 X20.3929 Y44.2786 I11.4359 J13.9003
G1 X24.4249 Y42.3984
; progress: percent=59 remaining_s=27
G1 X28.4569 Y40.5183
G1 X32.4889 Y38.6381
; progress: percent=60 remaining_s=26
G1 X36.5209 Y36.7579
G1 X40.5529 Y34.8778
; progress: percent=61 remaining_s=25
G1 X44.5849 Y32.9976
; progress: percent=62 remaining_s=25
G1 X48.6169 Y31.1175
G1 X52.2612 Y28.5657
; progress: percent=63 remaining_s=24
G1 X55.9055 Y26.014
G1 X59.5497 Y23.4622
; progress: percent=64 remaining_s=23
G1 X63.194 Y20.9105
G1 X66.8383 Y18.3588
; progress: percent=65 remaining_s=23
G1 X70.4825 Y15.807
G1 X74.1268 Y13.2553
; progress: percent=66 remaining_s=22
G3 X78.1311 Y11.146 I10.3246 J14.7446
; progress: percent=67 remaining_s=21
G3 X82.535 Y10.1023 I6.3199 J16.854
G3 X87.06 Y10.1901 I1.9161 J17.8977
; progress: percent=68 remaining_s=21
G3 X91.42 Y11.4038 I-2.6089 J17.8099
G3 X95.3395 Y13.6667 I-6.9688 J16.5963
; progress: percent=69 remaining_s=20
G3 X98.5707 Y16.8358 I-10.8882 J14.3334
; progress: percent=70 remaining_s=20
G3 X100.9092 Y20.7106 I-14.1194 J11.1643
G3 X102.2072 Y25.0464 I-16.4581 J7.2892
; progress: percent=71 remaining_s=19
G3 X102.3827 Y29.5688 I-17.756 J2.9537
G1 X101.9949 Y34.0007
; progress: percent=72 remaining_s=18
G1 X101.6072 Y38.4326
G1 X101.2195 Y42.8645
; progress: percent=73 remaining_s=17
G1 X100.8317 Y47.2964
; progress: percent=74 remaining_s=17
G1 X100.444 Y51.7283
G1 X100.0562 Y56.1602
; progress: percent=75 remaining_s=16
G1 X99.6685 Y60.5921
G1 X100.0562 Y65.024
; progress: percent=76 remaining_s=15
G1 X100.444 Y69.4559
G1 X100.8317 Y73.8878
; progress: percent=77 remaining_s=15
G1 X101.2195 Y78.3197
; progress: percent=78 remaining_s=14
G1 X101.6072 Y82.7516
G1 X101.9949 Y87.1835
; progress: percent=79 remaining_s=14
G1 X102.3827 Y91.6154
G3 X102.4062 Y94.4565 I-17.9315 J1.569
; progress: percent=80 remaining_s=13
G3 X101.9823 Y97.2658 I-17.955 J-1.2726
G1 X103.9448 Y100.6649
G1 X105.9072 Y104.064
; progress: percent=81 remaining_s=12
G1 X107.8697 Y107.4631
G1 X109.8321 Y110.8621
; progress: percent=82 remaining_s=11
G1 X106.0385 Y113.0524
; progress: percent=83 remaining_s=11
G1 X102.2448 Y115.2427
G1 X98.4512 Y117.4329
; progress: percent=84 remaining_s=10
G1 X94.6575 Y119.6232
G1 X90.8639 Y121.8135
; progress: percent=85 remaining_s=10
G1 X87.0702 Y124.0037
G1 X85.1078 Y120.6046
; progress: percent=86 remaining_s=9
G1 X83.1453 Y117.2056
G1 X81.1829 Y113.8065
; progress: percent=87 remaining_s=8
G1 X79.2204 Y110.4074
G3 X76.5755 Y109.3698 I5.2307 J-17.2232
; progress: percent=88 remaining_s=8
G3 X74.1268 Y107.9289 I7.8758 J-16.1855
G1 X70.9381 Y105.6962
; progress: percent=89 remaining_s=7
G1 X67.7493 Y103.4634
G1 X64.5606 Y101.2306
; progress: percent=90 remaining_s=6
G1 X61.3719 Y98.9978
G1 X60.5527 Y98.4243
G1 X58.0953 Y96.7035 Z13 S0
M5
G0 Z30
G0 X0 Y0
M5
M2
; end of program, 292 lines
