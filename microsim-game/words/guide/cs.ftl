# Průvodce: co je vidět, nejvýš čtyřiceti slovy. Prameny jsou v anglickém souboru.

## Buňky a jejich části

amoeboid-cell = Měňavkovitá buňka
    .text = Bílé krvinky a měňavky lezou bez končetin: předek buňky se vysouvá a zadek se přitahuje. Neutrofily, nejhojnější bílé krvinky, takto loví bakterie.
membrane = Membrána
    .text = Buňku drží pohromadě dvojitá vrstva lipidů, tenká pět nanometrů. Snadno se ohýbá, ale praskne, když její plocha vzroste o několik procent; zásobu membrány mají buňky v záhybech.
pseudopod = Panožka
    .text = Kde rostou vlákna aktinu, vysouvá se membrána: panožka. Většina nových se odštěpí od poslední, střídavě vlevo a vpravo.
uropod = Uropod
    .text = Zadek lezoucí bílé krvinky, uropod, je hrbolek, který lpí na tom, co je za ním. Stahuje ho myozin, a tím žene zbytek buňky vpřed.
nucleus = Jádro
    .text = V jádře jsou geny. Bývá nejtužší částí buňky a rozhoduje, zda buňka projde úzkou mezerou; neutrofilu pomáhá, že jeho jádro má laloky.
phagocytosis = Fagocytóza
    .text = Membrána kořist obroste jako pohár a zavře se nad ní. Bílé krvinky tak odstraňují bakterie a měňavky se tím živí.
phagosome = Fagozom
    .text = Co buňka pohltila, leží v měchýřku z membrány, ve fagozomu. Během několika minut zkysne a enzymy kořist rozloží.
division = Dělení
    .text = Prstenec z aktinu a myozinu se kolem středu buňky stahuje jako šňůrka váčku, až zbude jen vlákno. To se přetrhne a poloviny se rozlezou.

## Jiné organismy

rigid-cell = Nálevník
    .text = Trepka plave tisíci brv, které kmitají ve vlnách. Pevná blanka, pelikula, jí dává vlastní tvar: kolem překážek se ohne a zase se narovná.
red-cell = Červená krvinka
    .text = Váček hemoglobinu bez jádra, široký osm mikrometrů a uprostřed tenký. Nese kyslík a prohne se cévami, které jsou užší než ona.
platelet = Krevní destička
    .text = Destičky jsou úlomky obřích buněk kostní dřeně, široké dva až tři mikrometry, bez jádra. Ucpávají rány a žijí asi týden.
coccus = Kok
    .text = Staphylococcus aureus je kulička o průměru jednoho mikrometru, která neumí plavat: strkají do ní molekuly vody. Roste v hroznech.
bacillus = Tyčinka
    .text = Escherichia coli je tyčinka jeden krát dva mikrometry. Asi sekundu plave rovně, pak se převrátí do nového směru a plave dál. K potravě plave déle.
agar = Agar
    .text = Rosol z červených řas, na kterém se od osmdesátých let 19. století pěstují mikrobi: Fanny Hesseová ho znala z kuchyně. Bakterie ho stráví zřídka, zdejší buňky ano.
probe = Sonda
    .text = Kovová kulička, kterou vede experimentátor. Crick a Hughes magnetickými částicemi v živých buňkách zkoušeli, jak hustá je cytoplazma.
custom = Těleso z disků
    .text = Někdo ho sestavil z disků a vazeb. Tak jsou tu sestavena všechna tělesa: počítač disky posune a pak je opravuje, až vazby souhlasí.

## Kolem nich

fluid-block = Voda
    .text = V měřítku buňky je voda jako sirup: tření vítězí nad setrvačností. Bakterie, která přestane plavat, dojede méně než o šířku atomu.
medium = Prostředí
    .text = Jen voda, soli a bílkoviny. Jejich molekuly strkají do všeho malého: Brownův pohyb. Perrin ho změřil a přesvědčil svět, že atomy existují.
scent = Pach
    .text = Z kořisti unikají molekuly, které se šíří difuzí. Buňka porovnává, kolik jich kde po stranách zachytí, a obrací se tam, kde je jich víc: chemotaxe.
wall = Stěna
    .text = Kanálky tenčí než vlas se odlévají ze silikonové gumy, aby bylo vidět, jak se buňky protahují mezerami a volí si cestu.

## Způsoby pohledu

phase-contrast = Fázový kontrast
    .text = Buňka světlo zpožďuje, což žádné oko nevidí. Prstenec Fritse Zernika mění zpoždění v jas: co je tlusté, je tmavé, se světlým halo. Nobelova cena z roku 1953.
negative-phase-contrast = Negativní fázový kontrast
    .text = Fázový kontrast naopak: co je tlusté, září na šedém pozadí a halo je tmavé.
dic = Interferenční kontrast
    .text = Buňkou procházejí dva paprsky vedle sebe, méně než mikrometr od sebe. Kde se jeden zpozdí víc než druhý, je obraz světlejší nebo tmavší, jako by světlo přicházelo z boku.
dark-field = Temné pole
    .text = Světlo přichází z boku a míjí objektiv: září jen to, co je rozptyluje. Vidět jsou i věci menší než vlnová délka, jejich tvar však ne.
bright-field = Světlé pole
    .text = Světlo zdola, jako v prvních mikroskopech. Živé buňky jsou skoro tak čiré jako voda: okraje jsou nejlépe vidět trochu mimo ohnisko.
stained = Barvený nátěr
    .text = Zaschlá kapka krve ve směsi modrého a červeného barviva: jádra zfialoví, červené krvinky zrůžoví a podle granul se rozliší druhy bílých krvinek.
fluorescence = Fluorescence
    .text = Barviva pohlcují světlo jedné barvy a vydávají jinou. Jedno tu barví jádra modře, druhé cytoplazmu zeleně; co barvivo nemá, zůstává tmavé.
classic = Klasický
    .text = Tak vypadal program, z jehož popisu v bakalářské práci tento vyrostl: buňky pomalované texturami. Světlo v tom nehraje roli.
drawn = Kresba
    .text = Každá část má svou barvu, jako v učebnici. Před fotografií se kreslilo: první bakterie, které kdo viděl, jsou na kresbě v Leeuwenhoekově dopise z roku 1683.
