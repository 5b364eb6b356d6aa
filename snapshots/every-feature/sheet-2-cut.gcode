; stargrip-cam cut program
; name: every feature
; program: purpose=cut sheet=2 stars=2
; frame: origin at lower left of the sheet, Z0 on the release layer
; cutting: speed_mm_s=4 height_mm=-1
; cutting: tool=hot-tip temperature_C=350
; machine: dialect=grbl heating=operator arcs=yes line=72
; heights: contact_mm=-0.3 travel_mm=5 park_mm=30 ramp_mm=3
; path: tolerance_mm=0.001 travel_mm_s=20 dwell=s
; requires: $1=255 so that the motors hold at every stop
; requires: a send-and-wait host is late at each stroke: feedcheck
; length: cut=1 edge=registration-1 length_mm=8.383 time_s=5
; length: cut=2 edge=registration-2 length_mm=8.383 time_s=5
; length: cut=3 edge=registration-3 length_mm=8.383 time_s=5
; length: cut=4 edge=cut-hole-1 length_mm=211.167 time_s=56
; length: cut=5 edge=cut-outside-1 length_mm=411.338 time_s=106
; total: length_mm=647.654 time_s=213
G21
G17
G91.1
G90
G94
G0 Z30
; tool: tool=hot-tip temperature_C=350
; take the release layer off, keep the sheet where it is
; the hot tip in, X Y as before, its tip at Z0, press start
M0
; heat: temperature_C=350
; set the iron to 350 C, standby off, wait until hot, press start
M0
G0 X26.3026 Y17.7341
G0 Z5
; cut: cut=1 edge=registration-1 length_mm=8.383 time_s=5
; progress: percent=3 remaining_s=207
G3 X24.9844 Y18.2064 Z2 I-0.9774 J-0.6522 F240
G3 X24.1502 Y17.0819 Z-1 I0.3408 J-1.1245
G3 X25.3252 Y15.9069 I1.175 J0
; progress: percent=4 remaining_s=205
G3 X26.5002 Y17.0819 I0 J1.175
G3 X25.3252 Y18.2569 I-1.175 J0
G3 X24.1502 Y17.0819 I0 J-1.175
G3 X24.5506 Y16.1983 I1.175 J-0.0001
G3 X25.8102 Y16.0117 Z1.6914 I0.7745 J0.8836
; progress: percent=5 remaining_s=202
G3 X26.5002 Y17.0819 Z4.3827 I-0.485 J1.0702
G3 X26.4599 Y17.387 Z5 I-1.175 J0
G0 X37.6942 Y12.4221
G0 Z5
; cut: cut=2 edge=registration-2 length_mm=8.383 time_s=5
; progress: percent=6 remaining_s=199
G3 X36.376 Y12.8944 Z2 I-0.9774 J-0.6522 F240
G3 X35.5418 Y11.7699 Z-1 I0.3408 J-1.1245
; progress: percent=7 remaining_s=198
G3 X36.7168 Y10.5949 I1.175 J0
G3 X37.8918 Y11.7699 I0 J1.175
G3 X36.7168 Y12.9449 I-1.175 J0
G3 X35.5418 Y11.7699 I0 J-1.175
; progress: percent=8 remaining_s=196
G3 X35.9422 Y10.8863 I1.175 J-0.0001
G3 X37.2018 Y10.6997 Z1.6914 I0.7745 J0.8836
G3 X37.8918 Y11.7699 Z4.3827 I-0.485 J1.0702
; progress: percent=9 remaining_s=194
G3 X37.8515 Y12.075 Z5 I-1.175 J0
G0 X111.347 Y102.7785
G0 Z5
; cut: cut=3 edge=registration-3 length_mm=8.383 time_s=5
; progress: percent=12 remaining_s=187
G3 X110.0289 Y103.2508 Z2 I-0.9774 J-0.6522 F240
G3 X109.1946 Y102.1263 Z-1 I0.3407 J-1.1245
G3 X110.3696 Y100.9513 I1.175 J0
; progress: percent=13 remaining_s=185
G3 X111.5446 Y102.1263 I0 J1.175
G3 X110.3696 Y103.3013 I-1.175 J0
G3 X109.1946 Y102.1263 I0 J-1.175
G3 X109.595 Y101.2427 I1.175 J-0.0001
G3 X110.8546 Y101.0561 Z1.6914 I0.7745 J0.8836
; progress: percent=14 remaining_s=183
G3 X111.5446 Y102.1263 Z4.3827 I-0.485 J1.0702
G3 X111.5043 Y102.4314 Z5 I-1.175 J0
G0 X86.5775 Y72.0678
G0 Z5
; cut: cut=4 edge=cut-hole-1 length_mm=211.167 time_s=56
; progress: percent=16 remaining_s=178
G1 X87.8454 Y74.7867 Z-1 F240
; progress: percent=17 remaining_s=177
G1 X89.9491 Y79.2981
G1 X92.0528 Y83.8096
; progress: percent=18 remaining_s=174
G1 X87.5414 Y81.7059
G1 X83.0299 Y79.6021
; progress: percent=19 remaining_s=172
G1 X78.5185 Y77.4984
; progress: percent=20 remaining_s=170
G1 X74.007 Y75.3947
G2 X69.9597 Y74.183 I-6.1597 J13.2094
; progress: percent=21 remaining_s=168
G2 X65.735 Y74.183 I-2.1123 J14.4211
G2 X61.6877 Y75.3947 I2.1124 J14.4211
; progress: percent=22 remaining_s=166
G1 X57.1763 Y77.4984
G1 X52.6648 Y79.6021
; progress: percent=23 remaining_s=164
G1 X48.1534 Y81.7059
G1 X43.6419 Y83.8096
; progress: percent=24 remaining_s=161
G1 X45.7456 Y79.2981
; progress: percent=25 remaining_s=160
G1 X47.8494 Y74.7867
G1 X49.9531 Y70.2752
; progress: percent=26 remaining_s=157
G1 X52.0568 Y65.7638
G2 X53.2685 Y61.7165 I-13.2094 J-6.1597
; progress: percent=27 remaining_s=155
G2 X53.2685 Y57.4917 I-14.4211 J-2.1124
G2 X52.0568 Y53.4445 I-14.4211 J2.1126
; progress: percent=28 remaining_s=153
G1 X49.9531 Y48.933
G1 X47.8494 Y44.4216
; progress: percent=29 remaining_s=150
G1 X45.7456 Y39.9101
; progress: percent=30 remaining_s=149
G1 X43.6419 Y35.3987
G1 X48.1534 Y37.5024
; progress: percent=31 remaining_s=147
G1 X52.6648 Y39.6061
G1 X57.1763 Y41.7098
; progress: percent=32 remaining_s=144
G1 X61.6877 Y43.8136
G2 X65.735 Y45.0252 I6.1594 J-13.2096
; progress: percent=33 remaining_s=142
G2 X69.9597 Y45.0252 I2.1124 J-14.4211
G2 X74.007 Y43.8136 I-2.1121 J-14.4212
; progress: percent=34 remaining_s=140
G1 X78.5185 Y41.7098
; progress: percent=35 remaining_s=138
G1 X83.0299 Y39.6061
G1 X87.5414 Y37.5024
; progress: percent=36 remaining_s=136
G1 X92.0528 Y35.3987
G1 X89.9491 Y39.9101
; progress: percent=37 remaining_s=134
G1 X87.8454 Y44.4216
G1 X85.7417 Y48.933
; progress: percent=38 remaining_s=131
G1 X83.6379 Y53.4445
; progress: percent=39 remaining_s=130
G2 X82.4263 Y57.4917 I13.2095 J6.1595
G2 X82.4263 Y61.7165 I14.4211 J2.1124
; progress: percent=40 remaining_s=128
G2 X83.6379 Y65.7638 I14.4212 J-2.1121
G1 X85.7417 Y70.2752
; progress: percent=41 remaining_s=125
G1 X87.8454 Y74.7867
G1 X88.268 Y75.693
G1 X89.5358 Y78.4119 Z5
G0 X19.8804 Y111.8137
G0 Z5
; cut: cut=5 edge=cut-outside-1 length_mm=411.338 time_s=106
; progress: percent=45 remaining_s=117
G1 X17.7591 Y109.6924 Z-1 F240
; progress: percent=46 remaining_s=115
G1 X14.8467 Y106.78
G1 X11.9343 Y103.8676
; progress: percent=47 remaining_s=113
G1 X9.022 Y100.9552
G3 X9.022 Y100.8492 I0.0531 J-0.053
G1 X11.8461 Y98.025
G1 X14.6702 Y95.2009
; progress: percent=48 remaining_s=110
G1 X17.4943 Y92.3768
G3 X17.2622 Y88.2393 I20.8239 J-3.2434
; progress: percent=49 remaining_s=108
G3 X17.8442 Y84.1363 I21.056 J0.894
G3 X19.2178 Y80.2266 I20.474 J4.997
; progress: percent=50 remaining_s=106
G1 X21.1411 Y76.1021
G1 X23.0644 Y71.9776
; progress: percent=51 remaining_s=104
G1 X24.9876 Y67.8531
G1 X26.9109 Y63.7286
; progress: percent=52 remaining_s=101
G1 X28.8342 Y59.6041
; progress: percent=53 remaining_s=100
G1 X26.9109 Y55.4796
G1 X24.9876 Y51.3551
; progress: percent=54 remaining_s=98
G1 X23.0644 Y47.2307
G1 X21.1411 Y43.1062
; progress: percent=55 remaining_s=96
G1 X19.2178 Y38.9817
G3 X17.7249 Y34.5548 I19.1005 J-8.9065
; progress: percent=56 remaining_s=93
G3 X17.2439 Y29.9078 I20.5933 J-4.48
G3 X17.7985 Y25.269 I21.0743 J0.167
; progress: percent=57 remaining_s=91
G3 X19.3615 Y20.8664 I20.5197 J4.8061
G3 X21.856 Y16.9163 I18.9567 J9.2086
; progress: percent=58 remaining_s=89
G3 X25.1595 Y13.6128 I16.4622 J13.1587
; progress: percent=59 remaining_s=87
G3 X29.1096 Y11.1183 I13.1587 J16.4622
G3 X33.5123 Y9.5553 I9.2086 J18.9567
; progress: percent=60 remaining_s=85
G3 X38.1511 Y9.0007 I4.8058 J20.5197
G3 X42.7981 Y9.4816 I0.1675 J21.0743
; progress: percent=61 remaining_s=83
G3 X47.2249 Y10.9746 I-4.4802 J20.5933
G1 X51.3494 Y12.8978
; progress: percent=62 remaining_s=80
G1 X55.4739 Y14.8211
G1 X59.5984 Y16.7444
; progress: percent=63 remaining_s=78
G1 X63.7229 Y18.6677
G1 X67.8474 Y20.591
; progress: percent=64 remaining_s=76
G1 X71.9719 Y18.6677
G1 X76.0963 Y16.7444
; progress: percent=65 remaining_s=74
G1 X80.2208 Y14.8211
; progress: percent=66 remaining_s=72
G1 X84.3453 Y12.8978
G1 X88.4698 Y10.9746
; progress: percent=67 remaining_s=70
G3 X92.8967 Y9.4816 I8.9069 J19.1003
G3 X97.5437 Y9.0007 I4.4795 J20.5934
; progress: percent=68 remaining_s=68
G3 X102.1825 Y9.5553 I-0.167 J21.0743
G3 X106.5851 Y11.1183 I-4.8061 J20.5197
; progress: percent=69 remaining_s=65
G3 X110.5352 Y13.6128 I-9.2086 J18.9567
G3 X113.8387 Y16.9163 I-13.1587 J16.4622
; progress: percent=70 remaining_s=63
G3 X116.3332 Y20.8664 I-16.4622 J13.1587
G3 X117.8962 Y25.269 I-18.9567 J9.2087
; progress: percent=71 remaining_s=61
G3 X118.4508 Y29.9078 I-20.5197 J4.8058
; progress: percent=72 remaining_s=60
G3 X117.9699 Y34.5548 I-21.0743 J0.1675
G3 X116.4769 Y38.9817 I-20.5933 J-4.48
; progress: percent=73 remaining_s=57
G1 X114.5536 Y43.1062
G1 X112.6304 Y47.2307
; progress: percent=74 remaining_s=55
G1 X110.7071 Y51.3551
G1 X108.7838 Y55.4796
; progress: percent=75 remaining_s=53
G1 X106.8605 Y59.6041
G1 X108.7838 Y63.7286
; progress: percent=76 remaining_s=50
G1 X110.7071 Y67.8531
G1 X112.6304 Y71.9776
; progress: percent=77 remaining_s=48
G1 X114.5536 Y76.1021
G1 X116.4769 Y80.2266
; progress: percent=78 remaining_s=46
G3 X117.9699 Y84.6534 I-19.1003 J8.907
; progress: percent=79 remaining_s=45
G3 X118.4508 Y89.3004 I-20.5934 J4.4795
G3 X117.8962 Y93.9392 I-21.0743 J-0.167
; progress: percent=80 remaining_s=42
G3 X116.3332 Y98.3418 I-20.5197 J-4.8061
G3 X113.8387 Y102.292 I-18.9569 J-9.2083
; progress: percent=81 remaining_s=40
G3 X110.5352 Y105.5954 I-16.462 J-13.159
G3 X106.5851 Y108.09 I-13.159 J-16.462
; progress: percent=82 remaining_s=38
G3 X102.1825 Y109.6529 I-9.2083 J-18.9569
G3 X97.5437 Y110.2076 I-4.8063 J-20.5196
; progress: percent=83 remaining_s=35
G3 X92.8967 Y109.7266 I-0.167 J-21.0743
G3 X88.4698 Y108.2337 I4.4796 J-20.5934
; progress: percent=84 remaining_s=33
G1 X84.3453 Y106.3104
; progress: percent=85 remaining_s=32
G1 X80.2208 Y104.3871
G1 X76.0963 Y102.4638
; progress: percent=86 remaining_s=30
G1 X71.9719 Y100.5406
G1 X67.8474 Y98.6173
; progress: percent=87 remaining_s=27
G1 X63.7229 Y100.5406
G1 X59.5984 Y102.4638
; progress: percent=88 remaining_s=25
G1 X55.4739 Y104.3871
G1 X51.3494 Y106.3104
; progress: percent=89 remaining_s=23
G1 X47.2249 Y108.2337
G3 X43.3152 Y109.6073 I-8.9067 J-19.1004
; progress: percent=90 remaining_s=21
G3 X39.2122 Y110.1893 I-4.997 J-20.474
G3 X35.0747 Y109.9571 I-0.8936 J-21.056
; progress: percent=91 remaining_s=19
G1 X32.2506 Y112.7813
G1 X29.4265 Y115.6054
; progress: percent=92 remaining_s=17
G1 X26.6023 Y118.4295
G3 X26.4963 Y118.4295 I-0.053 J-0.0531
G1 X23.5839 Y115.5171
; progress: percent=93 remaining_s=14
G1 X20.6715 Y112.6048
G1 X17.7591 Y109.6924
; progress: percent=94 remaining_s=12
G1 X17.052 Y108.9853
G1 X14.9307 Y106.8639 Z5
G0 Z30
G0 X0 Y0
M2
; end of program, 308 lines
